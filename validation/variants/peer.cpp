#include "validation/variants/peer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "fathom/numeric/errors.h"

namespace fathom::validation {
namespace {

constexpr Renderer all_renderers[] = {Renderer::vtk, Renderer::opengl, Renderer::embree,
                                      Renderer::blender};
static_assert(std::variant_size_v<Peer> == std::size(all_renderers));

std::string name_of(const EmbreeVariant& variant) {
  return variant.robust ? "robust" : "default";
}

std::string name_of(const BlenderVariant& /*variant*/) {
  return "cycles";
}

std::optional<Peer> peer_if_named(Renderer renderer, std::string_view variant) {
  const auto either = [](const auto& found) -> std::optional<Peer> {
    if (!found) return std::nullopt;
    return Peer(*found);
  };
  switch (renderer) {
    case Renderer::vtk:
      return either(vtk_variant_named(variant));
    case Renderer::opengl:
      return either(opengl_variant_named(variant));
    case Renderer::embree:
      for (const bool robust : {false, true}) {
        const EmbreeVariant embree{.robust = robust};
        if (name_of(embree) == variant) return embree;
      }
      return std::nullopt;
    case Renderer::blender:
      if (variant == name_of(BlenderVariant{})) return BlenderVariant{};
      return std::nullopt;
  }
  return std::nullopt;
}

std::string variant_names(Renderer renderer) {
  switch (renderer) {
    case Renderer::vtk:
      return vtk_variant_names();
    case Renderer::opengl:
      return opengl_variant_names();
    case Renderer::embree:
      return "default and robust";
    case Renderer::blender:
      break;
  }
  return "cycles";
}

using ModelName = std::optional<std::string>;

ModelName matching_model_of(Storage storage, bool reversed) {
  if (!reversed) return "gl-" + std::string(name_of(storage));
  if (storage == Storage::float32) return "gl-float32-reversed";
  return std::nullopt;
}

ModelName matching_model_of(const VtkVariant& variant) {
  using Encoding = VtkVariant::Encoding;
  const bool reversed = variant.encoding == Encoding::reversed;
  if (!variant.attachment || variant.samples > 0) return std::nullopt;
  if (!reversed && variant.encoding != Encoding::interpolated) return std::nullopt;
  return matching_model_of(*variant.attachment, reversed);
}

ModelName matching_model_of(const OpenGlVariant& variant) {
  if (variant.samples > 1 || variant.offset_units > 0) return std::nullopt;
  return matching_model_of(variant.storage, variant.reversed);
}

ModelName matching_model_of(const EmbreeVariant& /*variant*/) {
  return "float32-ray";
}

ModelName matching_model_of(const BlenderVariant& /*variant*/) {
  return "cycles";
}

}  // namespace

std::optional<std::string> matching_model(const Peer& peer) {
  return std::visit([](const auto& variant) { return matching_model_of(variant); }, peer);
}

std::string name_of(Renderer renderer) {
  constexpr const char* names[] = {"vtk", "opengl", "embree", "blender"};
  return names[static_cast<std::size_t>(renderer)];
}

Renderer renderer_named(std::string_view name) {
  for (const Renderer renderer : all_renderers) {
    if (name_of(renderer) == name) return renderer;
  }
  throw UsageError(fmt::format("'{}' is not one of vtk, opengl, embree and blender", name));
}

Renderer renderer_of(const Peer& peer) {
  return all_renderers[peer.index()];
}

std::string variant_name(const Peer& peer) {
  return std::visit([](const auto& variant) { return name_of(variant); }, peer);
}

Peer peer_named(Renderer renderer, std::string_view variant) {
  if (const auto peer = peer_if_named(renderer, variant)) return *peer;
  throw UsageError(fmt::format("{} has no variant '{}', only {}", name_of(renderer), variant,
                               variant_names(renderer)));
}

std::vector<Peer> with_variants(std::span<const Peer> peers,
                                std::span<const std::string> variants) {
  const auto contains = [](const auto& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<Peer> chosen;
  std::vector<std::string> existing;
  for (const Peer& peer : peers) {
    const std::string name = variant_name(peer);
    if (contains(variants, name)) chosen.push_back(peer);
    if (!contains(existing, name)) existing.push_back(name);
  }
  for (const std::string& wanted : variants) {
    if (contains(existing, wanted)) continue;
    throw UsageError(fmt::format("none of the renderers has a variant '{}'; there are {}", wanted,
                                 fmt::join(existing, ", ")));
  }
  return chosen;
}

}  // namespace fathom::validation
