#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "fathom/failures/warnings.h"
#include "fathom/mesh/segmentation.h"
#include "fathom/mesh_files/ply/ply_header.h"

/// Labels in PLY files. For this room's .cpp files only.
namespace fathom::mesh_files {

/// Which property labels triangles: its place among those of element `face` or, where no face has a
/// label, of element `vertex`. A triangle has the label of its three corners if they agree.
struct PlyLabels {
  std::optional<std::size_t> in_face, in_vertex;
};

/// The first property in the order of this list that is an integer for itself, of faces first:
/// label, category_id, category, class_id, class, semantic_id, semantic, segment_id, segment,
/// object_id, object, instance_id, instance. Warns of one of these names, where there is no such
/// property, that cannot be a label: a list, or one of floats.
PlyLabels find_ply_labels(const PlyHeader& header, const std::string& file, Warnings& warnings);

/// A number of the file as a label; `unsegmented` where it is none.
inline std::uint32_t label_from(std::int64_t number) {
  const bool is_label = number >= 0 && number < std::int64_t{unsegmented};
  return is_label ? static_cast<std::uint32_t>(number) : unsegmented;
}

/// The label of a triangle, by those of its corners.
inline std::uint32_t common_label(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return a == b && b == c ? a : unsegmented;
}

}  // namespace fathom::mesh_files
