#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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
  /// A triangle that is the first of its corners, by their hash.
  struct First {
    std::size_t hash;
    std::optional<std::uint32_t> number;
  };

  void grow();
  [[nodiscard]] std::size_t place_of(std::size_t hash) const;

  const TriangleSource& triangles_;
  /// An open table: in one piece, so that it is freed at once. Its size is a power of two.
  std::vector<First> table_ = std::vector<First>(16);
  std::size_t count_ = 0;
};

}  // namespace fathom::area
