#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Properties of triangles in files: their material, group, part and label.
namespace fathom {

/// A way to divide the triangles of a scene into segments.
enum class Segmentation {
  material,  ///< OBJ: usemtl; glTF: the material of the primitive
  group,     ///< OBJ: g; glTF: the mesh
  part,      ///< OBJ: o; glTF: the node
  label      ///< PLY: an integer property of faces or vertices. Numbers of the file, without names
};
inline constexpr std::array all_segmentations{Segmentation::material, Segmentation::group,
                                              Segmentation::part, Segmentation::label};

/// "This triangle belongs to no segment." Labels are below it.
inline constexpr std::uint32_t unsegmented = 0xFFFFFFFE;

/// The segments of a mesh by one segmentation.
struct TriangleSegments {
  Segmentation by = Segmentation::material;
  /// For each triangle the number of its segment, or `unsegmented`; or a single number, for all.
  std::vector<std::uint32_t> numbers;
  /// The name of each segment, UTF-8, no two the same. Readers list them by the first triangle that
  /// they have. Empty for labels.
  std::vector<std::string> names;

  [[nodiscard]] std::uint32_t of(std::uint32_t triangle) const {
    return numbers.size() == 1 ? numbers[0] : numbers[triangle];
  }
};

/// The segments of all triangles of an object; they override the segments of its mesh.
struct ObjectSegments {
  std::map<Segmentation, std::string> names;
  std::optional<std::uint32_t> label;
};

/// Numbers as TriangleSegments has them: a single one if all are the same.
inline std::vector<std::uint32_t> compact_segments(std::vector<std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers)
    if (number != numbers.front()) return numbers;
  if (!numbers.empty()) numbers.resize(1);
  return numbers;
}

}  // namespace fathom
