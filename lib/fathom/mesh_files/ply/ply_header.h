#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/segmentation.h"

/// The header of a PLY file: its elements and their properties, and the properties that are labels.
/// Only for .cpp files of this module.
namespace fathom::mesh_files {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Size of a value in bytes.
std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
  return type < PlyType::float32;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  /// For a list: the type of its count.
  std::optional<PlyType> count_type;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of the first property that has one of these names.
  [[nodiscard]] std::optional<std::size_t> find(
      std::initializer_list<std::string_view> names) const;
  /// The least number of bytes of a binary row: of lists only the count.
  [[nodiscard]] std::size_t least_row_size() const;
  [[nodiscard]] bool has_lists() const;
};

struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian } encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  /// Bytes and lines that the header takes up.
  std::size_t size = 0;
  std::uint64_t lines = 0;

  [[nodiscard]] const PlyElement* find(std::string_view name) const;
};

/// The end of the header is searched only in this many bytes of a file.
inline constexpr std::size_t longest_ply_header = std::size_t{128} << 10;

/// Reads the header of a PLY file; lines end with LF, CR LF or CR, as the first one does. Other
/// lines before the first element are skipped, with a warning: Blender 2.4 forgot the word
/// `comment`. Later ones are errors: they could be misspelt properties.
/// Fails    InputError "FILE: line N: …".
PlyHeader read_ply_header(std::string_view text, const std::string& file, Warnings& warnings);

/// Which property labels triangles: its place among those of element `face` or, where no face has a
/// label, of element `vertex`. A triangle has the label of its three corners if they agree.
struct PlyLabels {
  std::optional<std::size_t> in_face, in_vertex;
};

/// The first property in the order of this list that is a single integer, first of faces, then of
/// vertices: label, category_id, category, class_id, class, semantic_id, semantic, segment_id,
/// segment, object_id, object, instance_id, instance. Without such a property, warns of a property
/// of one of these names that cannot be a label: a list, or floats.
PlyLabels find_ply_labels(const PlyHeader& header, const std::string& file, Warnings& warnings);

/// A number of the file as a label; `unsegmented` if it cannot be a label.
inline std::uint32_t label_from(std::int64_t number) {
  const bool is_label = number >= 0 && number < std::int64_t{unsegmented};
  return is_label ? static_cast<std::uint32_t>(number) : unsegmented;
}

/// The label of a triangle, from the labels of its corners.
inline std::uint32_t common_label(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return a == b && b == c ? a : unsegmented;
}

}  // namespace fathom::mesh_files
