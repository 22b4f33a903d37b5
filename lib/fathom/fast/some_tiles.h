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

/// A map that is drawn in several places: each place draws some tiles of the image and receives, a
/// few at a time, the triangles that may touch these tiles. A tile depends neither on other tiles
/// nor on the order of its triangles: put together, the tiles equal the map of render_fast(), bit
/// for bit.
namespace fathom {

/// The tiles of an image: squares of side × side pixels, smaller at the right and the lower border,
/// numbered row by row from the top left.
struct ImageTiles {
  std::uint32_t side = 0, columns = 0, rows = 0;
  [[nodiscard]] std::uint32_t count() const { return columns * rows; }
};
/// Fails    InputError if there are 2³² tiles or more.
ImageTiles tiles_of(const Camera& camera);

/// Some triangles of an object of a scene, as a separate mesh, with their numbers in the scene in
/// ascending order. If `numbers` is empty, the numbers are consecutive from `first_number`.
struct SomeTriangles {
  std::uint32_t object = 0;
  Mesh mesh;
  std::uint32_t first_number = 0;
  std::vector<std::uint32_t> numbers;
};

/// Returns whether the tile of this number is wanted. Several threads may call it at once.
using WantedTile = std::function<bool(std::uint32_t)>;

/// A triangle and a tile that it may touch.
struct TileTouch {
  std::uint32_t tile;
  /// Its place, counted from 0 through all lists that were sorted together.
  std::uint32_t triangle;
};

/// Triangles with the tiles in which they may be visible or, if channel A is wanted, that they may
/// meet. They certainly touch no other tiles. Under a lens, the tiles of which some samples lie
/// near them.
class SortedTriangles {
 public:
  struct State;
  SortedTriangles();
  SortedTriangles(SortedTriangles&& other) noexcept;
  SortedTriangles& operator=(SortedTriangles&& other) noexcept;
  ~SortedTriangles();

  [[nodiscard]] const std::vector<SomeTriangles>& triangles() const;
  /// Adds, for each tile, the number of triangles that may touch it.
  void count(std::span<std::uint64_t> of_tiles) const;
  /// The number of triangles that may touch any of these tiles.
  [[nodiscard]] std::uint64_t count_triangles(const WantedTile& wanted_tile) const;
  /// In no order; some may occur twice.
  [[nodiscard]] std::vector<TileTouch> touches(const WantedTile& wanted_tile) const;

 private:
  friend class TilesInRounds;
  std::unique_ptr<State> state_;
};

/// Tiles of one image that are drawn in rounds. Scene and camera must outlive the object, which may
/// read triangles of the scene at any time.
/// Memory   the triangles that are drawn, about bytes_per_triangle each for each view, and what the
///          limits allow; of a lens 17 bytes for each pixel, too.
class TilesInRounds {
 public:
  struct Limits {
    /// Memory for tiles, up to 40 bytes per pixel, and for triangles that channel A needs again.
    /// Anything beyond it waits in files, in the folder that TMPDIR names.
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
  /// The same without statistics: these triangles have been counted elsewhere.
  SortedTriangles sort_again(std::vector<SomeTriangles> triangles);
  /// Sets the tiles to draw, by their numbers in ascending order. Call it once, before draw().
  void choose(std::vector<std::uint32_t> tiles);
  /// Draws triangles in these tiles.
  /// Fails    OutputError where there is no room for tiles in a file.
  void draw(const SortedTriangles& triangles);
  /// After all triangles have been drawn: the map of the rows of tiles first_row ≤ row < end_row;
  /// each row may be requested once. Values outside the chosen tiles are unspecified.
  /// Fails    as render_fast().
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row);
  /// Statistics of the work so far; `triangles` counts the triangles of the scene.
  [[nodiscard]] RenderStatistics statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fathom
