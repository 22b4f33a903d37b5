#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/nearness.h"
#include "fathom/geometry/frames.h"
#include "fathom/mesh/mesh.h"
#include "fathom/rendering/options.h"

namespace fathom::fast {

/// The edge functions of a triangle at the samples of a box and up to 8 samples beyond it, as in
/// TriangleSetup: c + a·x + b·y, with x and y from the box's first sample, is positive inside and
/// errs by at most `error`.
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

  // Consider the corner of a tile's part of the box where an edge function is greatest. If the
  // function is certainly negative there, it is negative at all samples of the part; and in all of
  // their pixels, because the part is enlarged by one sample on each side, where the bound still
  // holds. Products and sums are rounded monotonically, so a function that is negative throughout a
  // tile is negative throughout all tiles of the row on one side of it: missed tiles lie at the
  // ends of the row only.
  /// Empty if no tile is met.
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
  /// Whether an edge function is negative throughout these columns of tiles.
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

struct ImageVertex;

/// The visible side of a triangle. The front faces of a closed mesh hide its back faces: drawing
/// them first saves time.
enum class Side : std::uint8_t { front, back };

/// Consecutive triangles of one object; corners index `vertices`.
struct BoxRequest {
  const ImageVertex* vertices;
  std::uint32_t vertex_count;
  const CornerIndices* triangles;
  std::uint32_t count;  // at most BoxBatch::most
  std::uint32_t first_number;
  Cull cull;
  /// Include all pixels that triangles meet, not only pixels whose samples they can cover.
  bool by_area;
  std::uint32_t image_width, image_height;
  std::uint32_t tile_columns;
};

/// Whether the box meets so many tiles that some tiles are likely to miss its triangle.
inline bool meets_many_tiles(const PixelBox& box, std::uint32_t tile_size) {
  const std::uint32_t columns = box.last_column / tile_size - box.first_column / tile_size;
  const std::uint32_t rows = box.last_row / tile_size - box.first_row / tile_size;
  return columns != 0 && rows != 0 && columns + rows > 2;
}

/// The certain facts about the triangles: which can be visible, and where.
struct BoxBatch {
  static constexpr std::size_t most = 1024;

  struct Entries {
    std::size_t count = 0;
    std::array<std::uint64_t, most + 8> entries;
    /// In the lower halves.
    std::array<std::uint64_t, most + 8> nearness;
    [[nodiscard]] std::span<const std::uint64_t> all() const {
      return std::span(entries).first(count);
    }
  };
  /// Visible within one tile, by Side: its number in the upper, the triangle's in the lower half.
  std::array<Entries, 2> in_one_tile;
  /// Visible in several tiles.
  std::size_t in_more_tiles = 0;
  std::array<Side, most> side;
  /// The greatest q of a covered sample, moved_up_in_24_bits(), perhaps nearness_without_samples.
  std::array<std::uint32_t, most> nearest;
  std::array<std::uint32_t, most> number;
  std::array<PixelBox, most> box;
  /// The edge functions of the triangles whose boxes meet many tiles, in order.
  std::vector<BoxEdges> edges;
  /// The number of triangles with an unusable corner or an uncertain orientation.
  std::size_t unsettled = 0;
  std::array<std::uint32_t, most> unsettled_number;

  std::uint64_t degenerate = 0, culled = 0;
};

/// Fails    scene::ElementFault if a corner is not a vertex.
void box_triangles(const BoxRequest& request, BoxBatch& boxes);

}  // namespace fathom::fast
