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

/// The boxes of up to eight children, side by side, each around its exact triangles: the sides are
/// binary32 numbers rounded outwards. A child that does not exist has an empty box.
struct alignas(64) TreeNode {
  static constexpr std::size_t most_children = 8;

  TreeNode();

  /// By axis.
  std::array<std::array<float, most_children>, 3> lower, upper;
  /// The number of a node, or of the first block of a leaf.
  std::array<std::uint32_t, most_children> child{};
  /// How many triangles a leaf has; 0 for a node.
  std::array<std::uint32_t, most_children> triangles{};
};

/// So many triangles are tested at once.
inline constexpr std::size_t triangles_together = 4;

/// Triangles side by side: the coordinates of their corners, by corner and axis.
template <class Stored>
struct alignas(32) TriangleBlock {
  using Rows = std::array<std::array<Stored, triangles_together>, 3>;

  std::array<Rows, 3> corners{};
  std::array<std::uint32_t, triangles_together> numbers{};
};

/// A triangle with the same corners, in the same order, as one of a lower number: a ray meets both
/// at the same t, from the same side.
struct Repetition {
  std::uint32_t first = 0, number = 0;
  friend auto operator<=>(const Repetition&, const Repetition&) = default;
};

/// A tree of boxes around the triangles of a scene that have an area. No answer depends on its
/// shape, which is the same whatever the number of threads.
/// Source   binned surface-area heuristic [WBB08], with eight children at once
class RayTree {
 public:
  explicit RayTree(const TriangleSource& source);

  /// The root comes first; empty for a tree around nothing.
  [[nodiscard]] const std::vector<TreeNode>& nodes() const { return nodes_; }
  /// The blocks of all leaves: in binary32 if all coordinates are such numbers, as those of most
  /// files are, else in binary64. The others are empty.
  template <class Stored>
  [[nodiscard]] const std::vector<TriangleBlock<Stored>>& blocks() const {
    return std::get<std::vector<TriangleBlock<Stored>>>(blocks_);
  }
  [[nodiscard]] bool is_in_binary32() const { return is_in_binary32_; }
  /// The corners of a triangle in the tree's unit, by its place: triangles_together times the
  /// number of its block, and where it is in that.
  [[nodiscard]] std::array<Vector, 3> corners(std::size_t place) const;
  /// Whether those of an object are exactly the scene's.
  [[nodiscard]] bool has_exact_corners(std::size_t object) const {
    return has_exact_corners_[object];
  }
  /// Triangles that the tree leaves out because they repeat this one, by number. Crowds of equal
  /// triangles are there once, so that a ray does not test each of them.
  [[nodiscard]] std::span<const Repetition> repetitions(std::uint32_t first) const;
  [[nodiscard]] std::size_t repetition_count() const { return repeated_.size(); }
  /// Coordinates are counted in 2 to this power, and are below 1.
  [[nodiscard]] long power() const { return power_; }
  /// How far a coordinate of a corner in a block may be from the exact one, beside what is lost
  /// below 2⁻¹⁰⁷⁴.
  [[nodiscard]] double corner_error() const { return corner_error_; }

  /// A path from the root to a leaf has at most so many nodes.
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
