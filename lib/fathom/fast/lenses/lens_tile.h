#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/triangle/rays.h"
#include "fathom/triangle/referee.h"
#include "fathom/triangle/stored_quantity.h"

namespace fathom::fast {

struct ImageObject;

/// What a thread draws tiles of a lens with: the window's context, and the referee of the lens.
struct LensContext {
  const DrawContext& window;
  triangle::RayReferee& referee;
  const lens::Preimages& preimages;
  /// Those of the window.
  const ViewAxes& axes;
  const Camera& window_camera;
  const triangle::SceneRays& window_rays;
};

/// Rectangles around the samples of some parts of a tile that have a ray, in the window, from the
/// tile's origin there. Of parts without such samples: left > right.
template <std::size_t count>
struct Rectangles {
  using Numbers = std::array<float, count>;
  alignas(64) Numbers left;
  alignas(64) Numbers right;
  alignas(64) Numbers top;
  alignas(64) Numbers bottom;
};

/// Draws in a tile whose samples lie anywhere in a window.
class LensTile {
 public:
  /// From now on draws in this tile, which is empty or has been drawn into at these places.
  void start(Tile& tile, const Places::OfTile& places, const TileInWindow& where);

  /// Draws triangles of one object, by their numbers.
  void draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
            const LensContext& context);
  /// From now on, back faces are drawn.
  void begin_back_faces();
  /// A number that is not greater than the exact q at any sample that has a ray; −∞: none is known.
  [[nodiscard]] float farthest();

  [[nodiscard]] const Tile& tile() const { return *tile_; }
  [[nodiscard]] const TileInWindow& where() const { return where_; }
  [[nodiscard]] const Places::OfTile& places() const { return places_; }

  // For the vector code.
  Tile& tile() { return *tile_; }
  /// The samples in the window, from the tile's origin; 0 where there is no ray.
  std::array<float, TileShape::samples>& x() { return x_; }
  std::array<float, TileShape::samples>& y() { return y_; }
  /// By the numbers of blocks.
  Rectangles<TileShape::blocks>& blocks() { return blocks_; }
  /// The least top and the greatest bottom of each row of blocks.
  std::array<float, TileShape::blocks_of_row>& row_tops() { return row_tops_; }
  std::array<float, TileShape::blocks_of_row>& row_bottoms() { return row_bottoms_; }
  /// The four cells of each block, row by row, block by block.
  Rectangles<4 * TileShape::blocks>& cells() { return cells_; }
  /// Settles the sample with this index by binary64, and exactly where that does not.
  void settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::size_t i,
              const LensContext& context);

 private:
  Tile* tile_ = nullptr;
  Places::OfTile places_{};
  TileInWindow where_;
  alignas(64) std::array<float, TileShape::samples> x_;
  alignas(64) std::array<float, TileShape::samples> y_;
  Rectangles<TileShape::blocks> blocks_;
  alignas(32) std::array<float, TileShape::blocks_of_row> row_tops_;
  alignas(32) std::array<float, TileShape::blocks_of_row> row_bottoms_;
  Rectangles<4 * TileShape::blocks> cells_;
};

/// The depths of a tile's surfaces rounded to binary32 or to codes, by Tile::index(); +∞, or the
/// code 0, where there is no surface. Those that are open mean nothing.
struct LensDepths {
  alignas(64) std::array<float, TileShape::samples> depths;
  /// A bit for each sample: whether it shows a surface, and whether the bounds do not settle the
  /// depth of that. Four cells in each number.
  using Bits = std::array<std::uint64_t, TileShape::samples / 64>;
  Bits surface, open;

  [[nodiscard]] bool is_open(std::size_t i) const { return open[i / 64] >> i % 64 & 1; }
};

void round_depths(const LensTile& tile, LensDepths& rounded);
/// 0 also for a depth that is certainly above the greatest code, where that means no surface.
void round_to_codes(const LensTile& tile, const triangle::CodeFactor& factor, LensDepths& rounded);

}  // namespace fathom::fast
