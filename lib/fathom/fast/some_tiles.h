#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/mesh/mesh.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"

/// A map that is drawn in several places, each of which has some tiles of the image and is given
/// the triangles that may touch them, some at a time. What a tile shows depends neither on the
/// others nor on the order in which triangles come: put together, the tiles are the map of
/// render_fast(), bit for bit.
namespace fathom {

/// The tiles of an image: squares of side × side pixels, less at the right and below, numbered row
/// by row from the top left.
struct ImageTiles {
  std::uint32_t side = 0, columns = 0, rows = 0;
  [[nodiscard]] std::uint32_t count() const { return columns * rows; }
};
/// Fails    InputError if there are 2³² tiles or more.
ImageTiles tiles_of(const Camera& camera);

/// Some triangles of an object of a scene, as a mesh of their own, with the numbers that they have
/// in the scene, in ascending order; or else, where `numbers` is empty, those from `first_number`
/// on.
struct SomeTriangles {
  std::uint32_t object = 0;
  Mesh mesh;
  std::uint32_t first_number = 0;
  std::vector<std::uint32_t> numbers;
};

/// Whether a tile, by its number, is one that is asked for. Several threads may ask.
using WantedTile = std::function<bool(std::uint32_t)>;

/// That a triangle may touch a tile.
struct TileTouch {
  std::uint32_t tile;
  /// Counted from 0 through the lists that were sorted together.
  std::uint32_t triangle;
};

/// Triangles with the tiles in which they may be visible; where channel A is asked for, those that
/// they may meet. They certainly touch no others. Under a lens, the tiles of which some samples lie
/// near them.
class SortedTriangles {
 public:
  struct State;
  SortedTriangles();
  SortedTriangles(SortedTriangles&& other) noexcept;
  SortedTriangles& operator=(SortedTriangles&& other) noexcept;
  ~SortedTriangles();

  [[nodiscard]] const std::vector<SomeTriangles>& triangles() const;
  /// Adds how many triangles may touch each tile.
  void count(std::span<std::uint64_t> of_tiles) const;
  /// How many triangles may touch any of these tiles.
  [[nodiscard]] std::uint64_t count_triangles(const WantedTile& wanted_tile) const;
  /// In no order, and perhaps some twice.
  [[nodiscard]] std::vector<TileTouch> touches(const WantedTile& wanted_tile) const;

 private:
  friend class TilesInRounds;
  std::unique_ptr<State> state_;
};

/// Tiles of one image that are drawn in rounds. Scene and camera must outlive it; triangles of the
/// scene are asked for at any time.
/// Memory   the triangles that are drawn, about bytes_per_triangle each for each view, and what the
///          limits allow; of a lens 17 bytes for each pixel, too.
class TilesInRounds {
 public:
  struct Limits {
    /// For tiles, up to 40 bytes per pixel; for triangles that channel A needs again. What does not
    /// fit waits in files (TMPDIR says where).
    std::uint64_t tile_bytes = std::uint64_t{1} << 40, kept_bytes = std::uint64_t{1} << 40;
  };
  /// About what sorting and drawing in one view takes for each triangle, its mesh included.
  static constexpr std::uint32_t bytes_per_triangle = 240;

  /// Fails    as render_fast(), but for faults of meshes.
  TilesInRounds(const TriangleSource& scene, const Camera& camera, const RenderOptions& options,
                const Limits& limits);
  TilesInRounds(const TilesInRounds&) = delete;
  TilesInRounds& operator=(const TilesInRounds&) = delete;
  ~TilesInRounds();

  /// How many views sort each triangle: up to six for a camera whose lens bends rays. Sorted
  /// triangles take so many times the memory. The same wherever the image is drawn.
  [[nodiscard]] std::uint32_t view_count() const;

  /// Lists in the order of their triangles in the scene.
  /// Fails    InputError where a mesh has a fault.
  SortedTriangles sort(std::vector<SomeTriangles> triangles);
  /// The same, but statistics count nothing of it: these triangles have been counted elsewhere.
  SortedTriangles sort_again(std::vector<SomeTriangles> triangles);
  /// Says which tiles are drawn here, by their numbers in ascending order: once, before the first
  /// are.
  void choose(std::vector<std::uint32_t> tiles);
  /// Draws triangles in these tiles.
  /// Fails    OutputError where there is no room for tiles in a file.
  void draw(const SortedTriangles& triangles);
  /// When all have been drawn: the map of rows first_row ≤ row < end_row of tiles, each asked for
  /// once. Elsewhere than in these tiles it has any values.
  /// Fails    as render_fast().
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row);
  /// Of what was done up to now: `triangles` are those of the scene.
  [[nodiscard]] RenderStatistics statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fathom
