#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/area/coverage.h"
#include "fathom/fast/bins.h"
#include "fathom/fast/coverage/edge_balance.h"
#include "fathom/fast/coverage/edge_sieve.h"
#include "fathom/fast/coverage/pixel_union.h"
#include "fathom/fast/coverage/pixel_winding.h"
#include "fathom/fast/coverage/tile_rows.h"
#include "fathom/fast/tile.h"

namespace fathom::fast {

/// What is certain about a triangle whose area counts for channel A.
enum class CoverageClass : std::uint8_t {
  nothing,   // no point of it has a depth in the range that counts
  positive,  // certainly Δ > 0; all of it in front of the camera and in the range
  negative,  // certainly Δ < 0; all of it in front of the camera and in the range
  open       // none of these
};

struct CoverageTriangle {
  CoverageClass kind;
  /// Positive or negative, and so large that it pays to look at its pixels one by one.
  bool is_large;
  /// The pixels that it can meet, unless it is open.
  TileBox box;
};

/// Classifies triangles of an object, by their numbers in the scene, in a tile, several at once.
void classify_for_coverage(const ImageObject& object, std::span<const std::uint32_t> numbers,
                           const DepthRange& range, const PixelBox& tile,
                           CoverageTriangle* classes);

/// Channel A (specification, section 6), one tile after another, with the same values as
/// rounded_pixel_coverage().
///
/// How many triangles cover a point of the image changes only across edges that do not lie between
/// two adjacent triangles (EdgeBalance). A pixel that no such edge meets is covered wholly or not
/// at all, as its sample is, and one that a single triangle covers is covered wholly. That holds for
/// front faces alone, too: where they are seen to cover a pixel, back faces need not be looked at,
/// and in most tiles they do so everywhere. What is left is mostly silhouettes. There, the area between
/// such edges counts (PixelWinding) or, where triangles are cut by the range of depths, the area of
/// the union of what meets the pixel (PixelUnion). Where a bound does not settle the rounding, first the ends of the edges are
/// computed from exact numbers, and in the end the area.
class TileCoverage {
 public:
  struct Scene {
    const CoverageFrame& frame;
    const ImageObjects& objects;
    const std::vector<Bins>& bins;
    MapRows rows;
  };
  explicit TileCoverage(const Scene& scene) : scene_(scene) {}

  /// `tile` has been drawn; its triangles are those of the bins, which must be sorted by area, not
  /// by samples. Writes the values of its pixels into an image of this width.
  void write(const Tile& tile, std::uint32_t tile_number, const Tile::Context& context,
             float* values, std::uint32_t image_width);

 private:
  static constexpr std::uint32_t size = Tile::size;
  /// A triangle by affine functions over the tile, (0, 0) its top left corner, positive inside.
  struct Shape {
    std::uint32_t triangle;  // index into numbers_
    bool is_open;
    std::array<UncertainHalfPlane, 5> functions;
    std::uint32_t count = 0;
    [[nodiscard]] std::span<const UncertainHalfPlane> sides() const {
      return std::span(functions).first(count);
    }
  };
  /// A shape or an edge that meets a pixel; pixels are numbered by rows of the tile.
  struct Meeting {
    std::uint32_t pixel, index;
  };
  /// Meetings in the order of their pixels.
  class Meetings {
   public:
    void clear() { unsorted_.clear(); }
    void add(std::uint32_t pixel, std::size_t index) {
      unsorted_.push_back({pixel, static_cast<std::uint32_t>(index)});
    }
    void sort();
    /// Those of a pixel, in the order in which they were added.
    [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t pixel) const {
      return std::span(sorted_).subspan(starts_[pixel], starts_[pixel + 1] - starts_[pixel]);
    }

   private:
    std::vector<Meeting> unsorted_;
    std::vector<std::uint32_t> sorted_;
    std::array<std::uint32_t, std::size_t{size} * size + 1> starts_;
  };
  /// In pixels of the tile; the ends err by at most `error` in each coordinate, of which the
  /// roundings of this are a part.
  struct UnbalancedEdge {
    SquarePoint from, to;
    double error;
    int times;
    const ImageObject* object;
    std::uint32_t from_vertex, to_vertex;
  };

  // tile_coverage_open.cpp: which pixels are open.
  /// Adds the triangles of a side to those that are there; returns the index of the first of them.
  std::size_t add_triangles(Side side, std::uint32_t tile_number, const Tile::Context& context);
  /// Balances the edges of the triangles from `begin` on with what was left of others.
  void balance_edges(std::size_t begin);
  /// Finds pixels that front faces cover, whatever is behind them; returns whether all are covered.
  bool look_at_front();
  void collect_triangles(Side side, std::uint32_t tile_number);
  /// visit(object, first, end): indices into numbers_, from `begin` on.
  template <class Visit>
  void for_each_object(std::size_t begin, const Visit& visit) const;
  [[nodiscard]] const ImageObject& object_at(std::size_t i);
  void classify(std::size_t begin, const Tile::Context& context);
  void find_open_pixels();
  std::vector<EdgeBalance::Edge>& edges_left_of(const ImageObject& object);
  void balance_edges_of(const ImageObject& object, std::size_t first, std::size_t end);
  void sieve_edges(const ImageObject& object, std::size_t first, std::size_t end);
  void open_along(const ImageObject& object, const std::vector<EdgeBalance::Edge>& edges);
  template <class Visit>
  void for_each_row(const UnbalancedEdge& edge, const Visit& visit) const;
  [[nodiscard]] UnbalancedEdge edge_of(const ImageObject& object,
                                       const EdgeBalance::Edge& edge) const;
  void meet_edges();
  [[nodiscard]] bool misses_tile(const ImageVertex& p, const ImageVertex& q) const;
  [[nodiscard]] TileBox box_of(const UnbalancedEdge& edge, double margin) const;

  // tile_coverage_full.cpp: which pixels one triangle covers wholly.
  [[nodiscard]] TileBox whole() const {
    return {0, static_cast<std::int16_t>(area_.last_column - area_.first_column), 0,
            static_cast<std::int16_t>(area_.last_row - area_.first_row)};
  }
  /// Whether any pixel of the box is open, and not covered wholly.
  [[nodiscard]] bool is_open(const TileBox& box) const;
  [[nodiscard]] bool misses_tile(const Shape& shape) const;
  void look_at_open(std::size_t begin, const Tile::Context& context);
  bool fill_large(std::size_t begin);

  // tile_coverage.cpp: settling them.
  void settle(std::uint32_t tile_number, const Tile::Context& context);
  void meet_triangles();
  void meet(const TileBox& box, const Shape& shape);
  [[nodiscard]] Shape shape_of(const ImageObject& object, std::size_t i) const;
  [[nodiscard]] Shape exact_shape(std::size_t i, const Tile::Context& context) const;
  void settle_open(const Tile::Context& context);
  float settle_pixel(std::uint32_t pixel, const Tile::Context& context);
  /// settle_pixel() by exact numbers alone.
  float settle_pixel_exactly(std::uint32_t pixel, const Tile::Context& context);
  enum class Corners { computed, exact };
  [[nodiscard]] Interval area_between_edges(std::uint32_t pixel, Corners corners);
  [[nodiscard]] SquarePoint exact_corner(const ImageObject& object, std::uint32_t vertex,
                                         std::uint32_t pixel) const;
  [[nodiscard]] Interval area_of_union(std::uint32_t pixel);
  void add_to_union(const Shape& shape, std::uint32_t x, std::uint32_t y);

  Scene scene_;
  PixelBox area_;
  /// The triangles of the tile, those of one object next to each other, and their classes.
  std::vector<std::uint32_t> numbers_;
  std::vector<CoverageTriangle> classes_;
  /// The object that was asked for last.
  const ImageObject* object_ = nullptr;
  /// The sample shows a surface, a front face; covered wholly by one triangle, or by front faces;
  /// open; open at first, then found to be covered by one triangle.
  TileRows shown_{}, front_{}, full_{}, open_{}, met_{};
  /// What was found at open pixels, row by row.
  struct PixelValue {
    std::uint32_t pixel;
    float value;
  };
  std::vector<PixelValue> settled_;
  EdgeSieve sieve_;
  EdgeBalance balance_;
  /// What opposite edges leave of each object's, in the order of the objects.
  struct EdgesLeft {
    const ImageObject* object;
    std::vector<EdgeBalance::Edge> edges;
  };
  std::vector<EdgesLeft> left_;
  std::vector<EdgeBalance::Edge> met_edges_;
  std::vector<std::uint32_t> vertex_at_;
  std::vector<UnbalancedEdge> unbalanced_;
  std::vector<Shape> shapes_;
  /// For open triangles that may meet the tile, in the order of numbers_.
  std::vector<Shape> open_shapes_;
  /// For open pixels.
  Meetings shapes_at_, edges_at_;
  std::vector<std::uint32_t> exact_numbers_;
  PixelUnion union_;
  PixelWinding winding_;
};

}  // namespace fathom::fast
