#include "fathom/mesh_files/ply/ply_labels.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace fathom::mesh_files {
namespace {

constexpr std::array<std::string_view, 13> label_names{
    "label",      "category_id", "category",  "class_id", "class",       "semantic_id", "semantic",
    "segment_id", "segment",     "object_id", "object",   "instance_id", "instance"};

bool is_label(const PlyProperty& property) {
  return is_integer(property.type) && !property.count_type;
}

/// The first property by the order of names for which `suits` holds.
template <class Suits>
std::optional<std::size_t> find_label(const PlyElement* element, const Suits& suits) {
  if (!element) return std::nullopt;
  for (const std::string_view name : label_names) {
    const auto at = element->find({name});
    if (at && suits(element->properties[*at])) return at;
  }
  return std::nullopt;
}

}  // namespace

PlyLabels find_ply_labels(const PlyHeader& header, const std::string& file, Warnings& warnings) {
  PlyLabels labels;
  const PlyElement* const faces = header.find("face");
  const PlyElement* const vertices = header.find("vertex");
  labels.in_face = find_label(faces, is_label);
  if (!labels.in_face) labels.in_vertex = find_label(vertices, is_label);
  if (labels.in_face || labels.in_vertex) return labels;
  for (const PlyElement* const element : {faces, vertices}) {
    const auto at = find_label(element, [](const PlyProperty&) { return true; });
    if (!at) continue;
    const PlyProperty& property = element->properties[*at];
    warnings.push_back(file + ": property " + property.name + " of element " + element->name +
                       (property.count_type ? " is a list" : " is of floats") +
                       ": no labels are read from it, expected an integer");
  }
  return labels;
}

}  // namespace fathom::mesh_files
