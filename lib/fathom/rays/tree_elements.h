#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fathom/rays/placed_triangles.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/scene/triangle_source.h"

/// Triangles while a tree around them is built.
namespace fathom::rays {

inline constexpr float beyond_all = std::numeric_limits<float>::infinity();

/// A box along the axes; empty at first.
struct FloatBox {
  std::array<float, 3> lower{beyond_all, beyond_all, beyond_all};
  std::array<float, 3> upper{-beyond_all, -beyond_all, -beyond_all};

  void add(const FloatBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }
  /// Half of its surface.
  [[nodiscard]] float area() const {
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
  }
};

struct Element {
  /// Around the exact triangle.
  FloatBox box;
  std::uint32_t number = 0;

  /// Twice the middle of the box.
  [[nodiscard]] float centre(std::size_t axis) const { return box.lower[axis] + box.upper[axis]; }
};

/// The triangles that have an area, whatever the number of threads in the same order.
std::vector<Element> elements_of(const TriangleSource& source, const PlacedTriangles& triangles,
                                 double corner_error);

/// By object: whether in_unit() is exact for its corners. They are placed as they are, and the unit
/// loses nothing below 2⁻¹⁰⁷⁴.
std::vector<bool> objects_with_exact_corners(const TriangleSource& source, long power);
bool are_in_binary32(const PlacedTriangles& triangles);

using Elements = std::span<Element>;

/// Some elements, the box around them, and the box around their centres.
struct Part {
  Elements elements;
  FloatBox box, centres;

  explicit Part(Elements some) : elements(some) {
    for (const Element& e : elements) {
      box.add(e.box);
      const std::array<float, 3> centre{e.centre(0), e.centre(1), e.centre(2)};
      centres.add({centre, centre});
    }
  }
};

/// Whether no plane separates the elements: their centres are equal, as those of equal triangles.
bool is_crowd(Elements elements);

/// Two to eight parts of more than triangles_together elements, or one part of fewer. The part with
/// the largest box is split again and again: by the surface-area heuristic or, if `by_number`, into
/// halves. A crowd is split only if there are no other elements. Elements are sorted by part.
/// Source   [WBB08]
std::vector<Part> split_into_children(Elements elements, bool by_number);

/// Elements of a crowd without repeated triangles, which are added to `repeated`. Sorts the
/// elements; the first of equal ones, which remains, has the lowest number.
/// Exact    corners are compared in binary64, and then as exact numbers.
Elements without_repetitions(Elements crowd, const PlacedTriangles& triangles,
                             const TriangleSource& source, std::vector<Repetition>& repeated);

}  // namespace fathom::rays
