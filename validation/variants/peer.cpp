#include "validation/variants/peer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

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

Renderer plain_renderer_named(std::string_view name) {
  for (const Renderer renderer : all_renderers) {
    if (name_of(renderer) == name) return renderer;
  }
  std::vector<std::string> names;
  for (const Renderer renderer : all_renderers) names.push_back(name_of(renderer));
  throw UnknownName(fmt::format("'{}' is not one of vtk, opengl, embree and blender", name),
                    std::string(name), names);
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

/// What named models take for known of a driver does not hold of every one.
ModelName matching_model_of(const std::string& family, Storage storage, bool reversed,
                            Driver driver) {
  if (driver != Driver::usual) return std::nullopt;
  if (!reversed) return fmt::format("{}-{}", family, name_of(storage));
  if (storage == Storage::float32) return family + "-float32-reversed";
  return std::nullopt;
}

ModelName matching_model_of(const VtkVariant& variant) {
  using Encoding = VtkVariant::Encoding;
  const bool reversed = variant.encoding == Encoding::reversed;
  if (!variant.attachment || variant.samples > 0) return std::nullopt;
  if (!reversed && variant.encoding != Encoding::interpolated) return std::nullopt;
  return matching_model_of("vtk", *variant.attachment, reversed, variant.driver);
}

ModelName matching_model_of(const OpenGlVariant& variant) {
  if (variant.samples > 1 || variant.offset_units > 0) return std::nullopt;
  return matching_model_of("gl", variant.storage, variant.reversed, variant.driver);
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

std::string name_of(const DrivenRenderer& driven) {
  constexpr const char* names[] = {"vtk", "opengl", "embree", "blender"};
  const std::string name = names[static_cast<std::size_t>(driven.renderer)];
  return driven.driver == Driver::usual ? name : name + "@" + name_of(driven.driver);
}

DrivenRenderer renderer_named(std::string_view name) {
  const std::size_t at = name.find('@');
  const Renderer renderer = plain_renderer_named(name.substr(0, at));
  if (at == std::string_view::npos) return renderer;
  if (renderer != Renderer::vtk && renderer != Renderer::opengl) {
    throw UsageError(fmt::format("'{}': {} draws without OpenGL, only vtk and opengl take a driver",
                                 name, name_of(renderer)));
  }
  if (const auto driver = driver_named(name.substr(at + 1))) return {renderer, *driver};
  throw UnknownName(fmt::format("'{}': the driver is not one of {}", name, driver_names()),
                    std::string(name.substr(at + 1)), {"llvmpipe", "softpipe"});
}

DrivenRenderer renderer_of(const Peer& peer) {
  return std::visit(
      [&](const auto& variant) -> DrivenRenderer {
        const Renderer renderer = all_renderers[peer.index()];
        if constexpr (requires { variant.driver; }) return {renderer, variant.driver};
        return renderer;
      },
      peer);
}

void set_driver(Peer& peer, Driver driver) {
  std::visit(
      [&](auto& variant) {
        if constexpr (requires { variant.driver; }) variant.driver = driver;
      },
      peer);
}

std::string variant_name(const Peer& peer) {
  return std::visit([](const auto& variant) { return name_of(variant); }, peer);
}

Peer peer_named(const DrivenRenderer& driven, std::string_view variant) {
  const auto& [renderer, driver] = driven;
  if (auto peer = peer_if_named(renderer, variant)) {
    set_driver(*peer, driver);
    return *peer;
  }
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
    throw UnknownName(fmt::format("none of the renderers has a variant '{}'; there are {}", wanted,
                                  fmt::join(existing, ", ")),
                      wanted, existing);
  }
  return chosen;
}

}  // namespace fathom::validation
