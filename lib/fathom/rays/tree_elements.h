#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "fathom/rays/placed_triangles.h"

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

}  // namespace fathom::rays
