#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fathom/geometry/pixel_box.h"

namespace fathom::fast {

/// The edge functions of a triangle at the samples of a box and up to 8 beyond it, as those of
/// TriangleSetup: c + a·x + b·y, with x and y from the box's first sample, is positive inside, less
/// or more by at most `error`.
struct BoxEdges {
  std::array<double, 3> a, b, c;
  double error;
};

/// The part of a box that lies in tiles of one row and can meet the triangle.
class TileRowEdges {
 public:
  TileRowEdges(const BoxEdges& edges, const PixelBox& box, std::uint32_t tile_size,
               std::uint32_t tile_row)
      : edges_(edges), box_(box), part_(box), size_(tile_size) {
    part_.first_row = std::max(box.first_row, tile_row * size_);
    part_.last_row = std::min(box.last_row, tile_row * size_ + (size_ - 1));
    const double top = static_cast<double>(part_.first_row - box.first_row) - 1;
    const double bottom = static_cast<double>(part_.last_row - box.first_row) + 1;
    for (std::size_t k = 0; k < 3; ++k) {
      at_row_[k] = edges.c[k] + edges.b[k] * (edges.b[k] > 0 ? bottom : top);
    }
  }

  // An edge function that is certainly negative at the corner of a tile's part of the box where it
  // is greatest is so at all its samples; and in all of their pixels, as that part is taken to be
  // greater by one sample on each side, for which the bound holds, too. Products and sums are
  // rounded monotonically, so a function that is so in a tile is so in all tiles of the row on one
  // side of it: what is left between missed tiles at the row's ends are tiles of which none is.
  /// Empty if there is none.
  [[nodiscard]] PixelBox met() const {
    std::uint32_t first = box_.first_column / size_, last = box_.last_column / size_;
    if (misses(first, last)) return {};
    while (misses(first, first)) {
      if (first++ == last) return {};
    }
    while (last > first && misses(last, last)) --last;
    PixelBox met = part_;
    met.first_column = std::max(box_.first_column, first * size_);
    met.last_column = std::min(box_.last_column, last * size_ + (size_ - 1));
    return met;
  }

 private:
  /// Whether one of the edge functions is negative in all of some columns of tiles.
  [[nodiscard]] bool misses(std::uint32_t first_tile, std::uint32_t last_tile) const {
    const std::uint32_t first = std::max(box_.first_column, first_tile * size_);
    const std::uint32_t last = std::min(box_.last_column, last_tile * size_ + (size_ - 1));
    const double left = static_cast<double>(first - box_.first_column) - 1;
    const double right = static_cast<double>(last - box_.first_column) + 1;
    const auto is_negative = [&](std::size_t k) {
      return at_row_[k] + edges_.a[k] * (edges_.a[k] > 0 ? right : left) < -edges_.error;
    };
    return is_negative(0) || is_negative(1) || is_negative(2);
  }

  const BoxEdges& edges_;
  const PixelBox& box_;
  PixelBox part_;
  std::uint32_t size_;
  std::array<double, 3> at_row_;
};

/// Calls add(part) for parts of the box that lie in tiles of one row each; the tiles of the box
/// that have no part are certainly missed by the triangle.
/// Needs    a box that is not empty.
template <class Add>
void for_parts_met(const BoxEdges& edges, const PixelBox& box, std::uint32_t tile_size,
                   const Add& add) {
  for (std::uint32_t row = box.first_row / tile_size; row <= box.last_row / tile_size; ++row) {
    const PixelBox met = TileRowEdges(edges, box, tile_size, row).met();
    if (!met.is_empty()) add(met);
  }
}

}  // namespace fathom::fast
