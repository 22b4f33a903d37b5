#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/nearness.h"
#include "fathom/fast/bins/tiles_met.h"
#include "fathom/geometry/pixel_box.h"
#include "fathom/mesh/mesh.h"
#include "fathom/rendering/options.h"

namespace fathom::fast {

struct ImageVertex;

/// The side of a triangle that is seen. Where a mesh is closed its front faces hide the others:
/// drawn first, they save time.
enum class Side : std::uint8_t { front, back };

/// Consecutive triangles of one object; corners index `vertices`.
struct BoxRequest {
  const ImageVertex* vertices;
  std::uint32_t vertex_count;
  const CornerIndices* triangles;
  std::uint32_t count;  // at most BoxBatch::most
  std::uint32_t first_number;
  Cull cull;
  /// Take all pixels that triangles meet, not only those whose samples they can cover.
  bool by_area;
  std::uint32_t image_width, image_height;
  std::uint32_t tile_columns;
};

/// Whether so many tiles meet a box that some of them are likely to miss its triangle.
inline bool meets_many_tiles(const PixelBox& box, std::uint32_t tile_size) {
  const std::uint32_t columns = box.last_column / tile_size - box.first_column / tile_size;
  const std::uint32_t rows = box.last_row / tile_size - box.first_row / tile_size;
  return columns != 0 && rows != 0 && columns + rows > 2;
}

/// What is certain about them: which can be visible, and where.
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
  /// The edge functions of those whose boxes meet many tiles, one after the other.
  std::vector<BoxEdges> edges;
  /// A corner is not usable, or the orientation not certain.
  std::size_t unsettled = 0;
  std::array<std::uint32_t, most> unsettled_number;

  std::uint64_t degenerate = 0, culled = 0;
};

/// Fails    scene::ElementFault if a corner is none of the vertices.
void box_triangles(const BoxRequest& request, BoxBatch& boxes);

}  // namespace fathom::fast
