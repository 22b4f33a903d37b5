#include "validation/variants/vtk_variant.h"

#include "validation/variants/words.h"

namespace fathom::validation {
namespace {

using Encoding = VtkVariant::Encoding;
using Mesh = VtkVariant::Mesh;

struct NamedEncoding {
  Encoding encoding;
  std::string_view name;
};
constexpr NamedEncoding encodings[] = {{Encoding::interpolated, ""},
                                       {Encoding::reversed, "reversed"},
                                       {Encoding::reversed_by_shader, "reversed by shader"},
                                       {Encoding::logarithmic, "logarithmic"}};

constexpr std::string_view peeled = "own peeled", behind_peeled = "own behind peeled";

}  // namespace

std::string name_of(const VtkVariant& variant) {
  if (variant.mesh == Mesh::peeled) return std::string(peeled);
  if (variant.mesh == Mesh::behind_peeled) return std::string(behind_peeled);
  std::string name = variant.attachment ? std::string(name_of(*variant.attachment)) : "own";
  for (const NamedEncoding& e : encodings) {
    if (e.encoding == variant.encoding && !e.name.empty()) name += " " + std::string(e.name);
  }
  if (variant.samples > 0) name += " " + std::to_string(variant.samples) + " samples";
  return name;
}

std::optional<VtkVariant> vtk_variant_named(std::string_view name) {
  if (name == peeled) return VtkVariant{.mesh = Mesh::peeled};
  if (name == behind_peeled) return VtkVariant{.mesh = Mesh::behind_peeled};
  const std::vector<std::string_view> words = words_of(name);
  VtkVariant variant{.attachment = attachment_named(words[0])};
  if (!variant.attachment && words[0] != "own") return std::nullopt;
  if (words.size() == 1) return variant;
  if (words.size() == 3 && words[2] == "samples") {
    const auto samples = count_named(words[1], 1);
    if (!samples) return std::nullopt;
    variant.samples = *samples;
    return variant;
  }
  const std::string_view encoding = name.substr(words[0].size() + 1);
  for (const NamedEncoding& e : encodings) {
    if (e.name != encoding || encoding.empty()) continue;
    variant.encoding = e.encoding;
    return variant;
  }
  return std::nullopt;
}

std::string vtk_variant_names() {
  return "own, unorm16, unorm24, unorm32 and float32, each also with 'reversed', 'reversed by "
         "shader', 'logarithmic' or 'N samples'; and own peeled and own behind peeled";
}

}  // namespace fathom::validation
