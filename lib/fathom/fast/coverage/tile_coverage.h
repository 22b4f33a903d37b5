#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fathom/area/coverage.h"
#include "fathom/fast/bins/bins.h"
#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/coverage/coverage_classes.h"
#include "fathom/fast/coverage/pixel_area.h"
#include "fathom/fast/coverage/tile_outlines.h"
#include "fathom/fast/coverage/tile_rows.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/tiles/tile.h"

namespace fathom::fast {

/// Channel A (specification, section 6), one tile after another, with the same values as
/// rounded_pixel_coverage().
///
/// The number of triangles that cover a point of the image changes only across edges that do not
/// lie between two adjacent triangles (TileOutlines). A pixel that no such edge meets is covered
/// wholly or not at all, like its sample; a pixel inside a single triangle is covered wholly. Both
/// also hold for front faces alone: if front faces cover a pixel, its back faces are not examined,
/// and in most tiles front faces cover every pixel. The remaining pixels are mostly silhouettes.
/// Their area is the area between such edges (PixelWinding) or, where the range of depths cuts
/// triangles, the area of the union of the triangles that meet the pixel (PixelUnion). If a bound
/// does not settle the rounding, the ends of the edges are computed from exact numbers first, and
/// then the area.
class TileCoverage {
 public:
  struct Scene {
    const CoverageFrame& frame;
    const ImageObjects& objects;
    const std::vector<Bins>& bins;
    MapRows rows;
  };
  explicit TileCoverage(const Scene& scene) : scene_(scene) {}

  /// Writes the values of the pixels of `tile`, which has been drawn. The bins contain its
  /// triangles and must be sorted by area, not by samples.
  void write(const Tile& tile, std::uint32_t tile_number, const DrawContext& context, float* values,
             const MapLayout& layout);

 private:
  static constexpr std::uint32_t size = Tile::size;
  /// A triangle as affine functions that are positive inside it; (0, 0) is the tile's top left
  /// corner.
  struct Shape {
    std::uint32_t triangle;  // index into numbers_
    bool is_open;
    std::array<UncertainHalfPlane, 5> functions;
    std::uint32_t count = 0;
    [[nodiscard]] std::span<const UncertainHalfPlane> sides() const {
      return std::span(functions).first(count);
    }
  };

  // tile_coverage_full.cpp: the triangles of the tile, and which pixels are covered wholly.
  /// Finds the open pixels and the wholly covered pixels; returns whether any pixel is open but not
  /// wholly covered.
  bool find_open_pixels(std::uint32_t tile_number, const DrawContext& context);
  /// Adds the triangles of a side, and adds their edges to the outlines; returns the index of the
  /// first added triangle.
  std::size_t add_triangles(Side side, std::uint32_t tile_number, const DrawContext& context);
  /// Calls visit(object, first, end) for each run of consecutive indices whose numbers belong to
  /// one object.
  template <class Visit>
  void for_each_object(std::span<const std::uint32_t> numbers, const Visit& visit) const;
  /// Calls take(the class of a triangle, the class that is found) for some triangles, given as
  /// indices of numbers_.
  template <class Take>
  void classify(std::span<const std::size_t> which, const DrawContext& context, const Take& take);
  /// Finds the boxes of all positive and negative triangles, and whether each is large.
  void find_boxes(const DrawContext& context);
  void look_at_open(std::size_t begin, const DrawContext& context);
  void add_edges(std::size_t begin);
  /// Finds pixels that front faces cover, whatever is behind them; returns whether they cover all
  /// pixels.
  bool look_at_front();
  void mark_open();
  /// Looks for open pixels that the large triangles from index `begin` on cover, and treats these
  /// triangles as small afterwards; returns whether no open pixel is left.
  bool fill_large(std::size_t begin);
  /// Whether any pixel of the box is open, and not covered wholly.
  [[nodiscard]] bool is_open(const TileBox& box) const;
  [[nodiscard]] bool misses_tile(const Shape& shape) const;
  [[nodiscard]] const ImageObject& object_at(std::size_t i);
  [[nodiscard]] Shape shape_of(const ImageObject& object, std::size_t i) const;
  [[nodiscard]] Shape exact_shape(std::size_t i, const DrawContext& context);
  /// The number in the scene of numbers_[i], which is a number in the bins.
  [[nodiscard]] std::uint32_t number_in_scene(std::size_t i);

  // tile_coverage_counts.cpp: how many triangles cover a point of an open pixel.
  /// Prepares to count: finds columns to count from, and in other rows the triangles of each pixel.
  void prepare_counts();
  void find_references();
  void meet_triangles();
  void meet(const TileBox& box, const Shape& shape);
  /// Whether all of a pixel certainly lies inside a triangle, and whether all certainly lies
  /// outside.
  struct Sides {
    bool inside = true, outside = false;
  };
  static Sides is_pixel_of(const Shape& shape, int column, int row);
  /// The number at a point of the tile within a pixel, not counting open triangles; negative if it
  /// is not certain.
  [[nodiscard]] int number_at(std::uint32_t pixel, const SquarePoint& point) const;
  [[nodiscard]] int number_of_shapes_at(std::uint32_t pixel, const SquarePoint& point) const;
  /// The triangles that may meet a pixel, by their numbers in the scene.
  std::span<const std::uint32_t> triangles_at(std::uint32_t pixel);

  // tile_coverage.cpp: settling open pixels.
  void settle_open(const DrawContext& context);
  float settle_pixel(std::uint32_t pixel, const DrawContext& context);
  /// settle_pixel() by exact numbers alone.
  float settle_pixel_exactly(std::uint32_t pixel, const DrawContext& context);
  enum class Corners { computed, exact };
  [[nodiscard]] Interval area_between_edges(std::uint32_t pixel, Corners corners);
  /// The ends of an edge, or of its part near a pixel, relative to the pixel's corner: exact, and
  /// rounded once. `local`: the corner in the tile.
  [[nodiscard]] std::pair<SquarePoint, SquarePoint> exact_ends(const OutlineEdge& edge,
                                                               const SquarePoint& local,
                                                               const SquarePoint& corner) const;
  [[nodiscard]] Interval area_of_union(std::uint32_t pixel);
  void add_to_union(const Shape& shape, std::uint32_t x, std::uint32_t y);

  Scene scene_;
  PixelBox area_;
  /// The triangles of the tile, grouped by object, and their classes.
  std::vector<std::uint32_t> numbers_;
  std::vector<CoverageTriangle> classes_;
  /// Indices into numbers_ of the triangles that the bins leave in doubt, and of the others.
  std::vector<std::size_t> doubtful_, without_box_;
  // For classify():
  std::vector<std::uint32_t> numbers_to_classify_;
  std::vector<CoverageTriangle> classes_found_;
  /// For open triangles that may meet the tile, in the order of numbers_.
  std::vector<Shape> open_shapes_;
  TileOutlines outlines_;
  /// The object that was looked up last.
  const ImageObject* object_ = nullptr;
  /// The sample shows a surface, a front face; covered wholly by one triangle, or by front faces;
  /// open; open at first, then found to be covered by one triangle.
  TileRows shown_{}, front_{}, full_{}, open_{}, met_{};
  /// For each row, a column whose pixel no triangle covers and no edge meets; negative if there is
  /// none.
  std::array<int, size> reference_{};
  /// For open pixels of rows without such a column.
  std::vector<Shape> shapes_;
  PixelMeetings shapes_at_;
  std::vector<std::uint32_t> triangles_at_;
  PixelUnion union_;
  PixelWinding winding_;
  /// The results at open pixels, row by row.
  struct PixelValue {
    std::uint32_t pixel;
    float value;
  };
  std::vector<PixelValue> settled_;
};

}  // namespace fathom::fast
