#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"
#include "fathom/triangle/options.h"

/// A map that is drawn in several places, each of which has some tiles of the image and, of the
/// scene, the triangles that may touch them. What a tile shows does not depend on any others: put
/// together, the tiles are the map of render_fast(), bit for bit, but for `id`, which numbers the
/// triangles of each place from 0. Where these are in the order of the whole scene, ties between
/// them are decided as there.
namespace fathom {

/// The tiles of an image: squares of side × side pixels, less at the right and below, numbered row
/// by row from the top left.
struct ImageTiles {
  std::uint32_t side = 0, columns = 0, rows = 0;
  [[nodiscard]] std::uint32_t count() const { return columns * rows; }
};
/// Fails    InputError if there are 2³² tiles or more.
ImageTiles tiles_of(const Camera& camera);

/// That a triangle, by its number in the scene, may touch a tile.
struct TileTouch {
  std::uint32_t tile, triangle;
};
/// For each triangle the tiles in which it may be visible; those that it may meet, where channel A is
/// asked for. It certainly touches no others. In no order, and perhaps some twice.
/// Fails    as render_fast(), but never with an OutputError. Of the statistics, those of triangles
///          and of facing are filled in.
std::vector<TileTouch> tiles_touched(const Scene& scene, const Camera& camera,
                                     const RenderOptions& options);

/// The map of render_fast() in these tiles, by their numbers, none twice; elsewhere it has any values.
/// Needs    in the scene, all triangles that touch these tiles.
/// Fails    as render_fast().
DepthMap render_tiles(const Scene& scene, const Camera& camera, const RenderOptions& options,
                      std::span<const std::uint32_t> tiles);

}  // namespace fathom
