#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "fathom/rays/placed_triangles.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::rays {

/// The boxes of up to eight children, side by side. Each contains its exact triangles: its sides
/// are binary32 numbers rounded outwards. A missing child has an empty box.
struct alignas(64) TreeNode {
  static constexpr std::size_t most_children = 8;

  TreeNode();

  /// By axis.
  std::array<std::array<float, most_children>, 3> lower, upper;
  /// The number of a node, or of the first block of a leaf.
  std::array<std::uint32_t, most_children> child{};
  /// The number of triangles of a leaf; 0 for a node.
  std::array<std::uint32_t, most_children> triangles{};
};

/// The number of triangles that are tested at once.
inline constexpr std::size_t triangles_together = 4;

/// Triangles side by side: the coordinates of their corners, by corner and axis.
template <class Stored>
struct alignas(32) TriangleBlock {
  using Rows = std::array<std::array<Stored, triangles_together>, 3>;

  std::array<Rows, 3> corners{};
  std::array<std::uint32_t, triangles_together> numbers{};
};

/// A triangle with the same corners, in the same order, as a triangle of a lower number: a ray
/// meets both at the same t, from the same side.
struct Repetition {
  std::uint32_t first = 0, number = 0;
  friend auto operator<=>(const Repetition&,
                          const Repetition&) = default;  // NOLINT(modernize-use-nullptr)
};

/// A tree of boxes around the triangles of a scene that have an area. No result depends on its
/// shape, and its shape does not depend on the number of threads.
/// Source   binned surface-area heuristic [WBB08], with eight children at once
class RayTree {
 public:
  explicit RayTree(const TriangleSource& source);

  /// The root comes first; empty for a tree around nothing.
  [[nodiscard]] const std::vector<TreeNode>& nodes() const { return nodes_; }
  /// The blocks of all leaves: in binary32 if all coordinates are binary32 numbers, as in most
  /// files, otherwise in binary64. The blocks of the other type are empty.
  template <class Stored>
  [[nodiscard]] const std::vector<TriangleBlock<Stored>>& blocks() const {
    return std::get<std::vector<TriangleBlock<Stored>>>(blocks_);
  }
  [[nodiscard]] bool is_in_binary32() const { return is_in_binary32_; }
  /// The corners of a triangle in the tree's unit, by its place: triangles_together times the
  /// number of its block, plus its position in the block.
  [[nodiscard]] std::array<Vector, 3> corners(std::size_t place) const;
  /// Whether the corners of an object are exactly the scene's.
  [[nodiscard]] bool has_exact_corners(std::size_t object) const {
    return has_exact_corners_[object];
  }
  /// The triangles that the tree leaves out because they repeat this triangle, by number. The tree
  /// has a crowd of equal triangles once, so that a ray does not test each of them.
  [[nodiscard]] std::span<const Repetition> repetitions(std::uint32_t first) const;
  [[nodiscard]] std::size_t repetition_count() const { return repeated_.size(); }
  /// Coordinates are counted in 2 to this power, and are below 1.
  [[nodiscard]] long power() const { return power_; }
  /// A bound on the error of the coordinates of corners in blocks, except for the loss below
  /// 2⁻¹⁰⁷⁴.
  [[nodiscard]] double corner_error() const { return corner_error_; }

  /// The greatest number of nodes on a path from the root to a leaf.
  static constexpr std::size_t most_levels = 72;

 private:
  long power_;
  double corner_error_;
  std::vector<TreeNode> nodes_;
  std::tuple<std::vector<TriangleBlock<float>>, std::vector<TriangleBlock<double>>> blocks_;
  bool is_in_binary32_ = false;
  /// By object.
  std::vector<bool> has_exact_corners_;
  /// Sorted.
  std::vector<Repetition> repeated_;
};

}  // namespace fathom::rays
