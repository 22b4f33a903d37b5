#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/fast/tiles/frame.h"

/// How TilesInRounds draws an image, with a lens or without.
namespace fathom::fast {

/// The triangles of a round, sorted into the tiles of a view: the image, or a window of a lens.
struct SortedView {
  ImageObjects objects;
  std::vector<Bins> bins;
  TileGrid grid;
  /// By the tiles of the image: the pixels of the window in which their samples lie. Null if the
  /// view is the image.
  const std::vector<PixelBox>* areas = nullptr;

  /// Calls visit(entries) for the lists of a tile of the image, one for each side and part of the
  /// triangles.
  template <class Visit>
  void for_each_list(std::uint32_t tile, const Visit& visit) const {
    const auto visit_lists = [&](std::uint32_t number) {
      for (const Bins& part : bins)
        for (const Side side : {Side::front, Side::back}) visit(part.in_tile(number, side));
    };
    areas ? grid.for_each_tile((*areas)[tile], visit_lists) : visit_lists(tile);
  }
};

/// Those of all views of an image.
using SortedViews = std::deque<SortedView>;

/// An image whose triangles come in rounds; those of a round are numbered from 0 through its lists.
/// The functions are those of TilesInRounds.
class ImageInRounds {
 public:
  /// Whether sorted triangles are counted by the statistics.
  enum class Counted { here, elsewhere };

  ImageInRounds() = default;
  ImageInRounds(const ImageInRounds&) = delete;
  ImageInRounds& operator=(const ImageInRounds&) = delete;
  virtual ~ImageInRounds() = default;

  [[nodiscard]] virtual std::uint32_t view_count() const = 0;
  virtual SortedViews sort(const std::vector<SomeTriangles>& lists, Counted counted) = 0;
  virtual void choose(std::vector<std::uint32_t> tiles) = 0;
  virtual void draw(const SortedViews& views) = 0;
  virtual DepthMap rows(std::uint32_t first_row, std::uint32_t end_row) = 0;
  [[nodiscard]] virtual RenderStatistics statistics() const = 0;
};

/// An image of a camera whose lens bends rays: its map is the one of render_fast(), bit for bit.
/// Its tiles are drawn in each view of the lens, as by render_lens_streamed(). All arguments but
/// the limits outlive it.
///
/// Memory   17 bytes for each sample of the image, beside the limits.
std::unique_ptr<ImageInRounds> lens_image(const TriangleSource& triangles, const Camera& camera,
                                          const RenderOptions& options,
                                          const TilesInRounds::Limits& limits);

/// Sorts the triangles of a round into the tiles of a frame.
SortedView sort_round(const std::vector<SomeTriangles>& lists, const TriangleSource& triangles,
                      const FastFrame& frame, FastWorkers& workers);

/// Some rows of tiles of an image, as a map of their own.
struct RowsOfTiles {
  RowsOfTiles(const Camera& camera, const TileGrid& grid, std::uint32_t first_row,
              std::uint32_t end_row);
  /// Fails with the fault of a pixel of the map, if there is one, by its place in the image.
  void require_no_fault(const FirstFault& fault, const DepthMap& map) const;

  /// Numbers of the tiles.
  std::uint32_t first_tile, end_tile;
  MapLayout layout;
  /// The camera with the height of these rows.
  Camera camera;
};

}  // namespace fathom::fast
