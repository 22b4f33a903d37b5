#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "fathom/scene/triangle_source.h"

namespace fathom::area {

/// Triangles of a scene without those that have the same three corners, in the same order round,
/// as an earlier one. These lie on each other and are culled alike, so only the one of the lowest
/// number is ever visible, and the others change no area.
class EqualTriangles {
 public:
  explicit EqualTriangles(const TriangleSource& triangles) : triangles_(triangles) {}

  /// Whether none of those asked for before has the corners of this one.
  /// Exact    corners are compared as exact numbers.
  bool is_first(std::uint32_t number);

 private:
  const TriangleSource& triangles_;
  std::unordered_multimap<std::size_t, std::uint32_t> by_hash_;
};

}  // namespace fathom::area
