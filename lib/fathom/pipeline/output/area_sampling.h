#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/output/output_merger.h"

/// A pixel's square, divided among its visible surfaces.
namespace fathom::pipeline {

/// A place in a pixel: x right, y down, from its upper left corner, in pixels.
struct PixelPoint {
  double x = 0, y = 0;
};

/// a·x + b·y + c at places of a pixel.
struct PixelForm {
  double a = 0, b = 0, c = 0;
  [[nodiscard]] double at(const PixelPoint& p) const { return a * p.x + b * p.y + c; }
  friend PixelForm operator-(const PixelForm& f, const PixelForm& g) {
    return {f.a - g.a, f.b - g.b, f.c - g.c};
  }
};

/// A triangle in the coordinates of a pixel.
struct PixelSurface {
  std::uint32_t number = 0;
  std::array<PixelForm, 3> edges;  ///< none is negative where the triangle is
  PixelForm nearness;              ///< greater is nearer; affine, as window depth and 1/w are
};

/// The visible part of a surface in a pixel.
struct SeenPart {
  std::uint32_t number;
  double area;          ///< of the pixel's 1
  PixelPoint centroid;  ///< of the visible area
};

/// The square as convex pieces, each with its visible surface. An added surface takes from each
/// piece the part within its edges and on its nearer side of the line in which the two planes
/// intersect. So surfaces that penetrate each other or overlap in a cycle are handled as well as
/// others, and the order of addition does not matter.
///
/// Rounded  places, to binary64. A line divides a piece into two that share its end points, so the
///          areas of all pieces always add up to 1 up to the rounding of their sum. The error of an
///          edge is at most some 2⁻⁵² of a pixel; the error of the line of two planes is the
///          rounding of their nearness over the slope of its difference.
class PixelPartition {
 public:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  /// Resets to the whole square without any surface.
  void clear();
  /// `always`: the added surface is visible, whatever is nearer (the painter's algorithm). If two
  /// surfaces are equally near, the lower number is visible.
  void add(const PixelSurface& surface, bool always = false);
  /// The visible parts, `nothing` included, by number.
  [[nodiscard]] const std::vector<SeenPart>& seen();

 private:
  using Polygon = std::vector<PixelPoint>;
  struct Piece {
    std::uint32_t number = nothing;
    PixelForm nearness;
    Polygon polygon;
  };

  void cut(const PixelForm& line, std::size_t seen_in, std::size_t& spare);
  Piece& spare_piece(std::size_t& count);

  /// The first `count_` are in use; the others keep their memory.
  std::vector<Piece> pieces_;
  std::size_t count_ = 0;
  Piece inside_;
  Polygon kept_;
  std::vector<double> values_;
  std::vector<SeenPart> seen_;
};

/// Area sampling: each pixel's colour is the mean of the surfaces that are seen in its square, each
/// weighted by its visible area and shaded at the centroid of that area (PixelPartition).
///
/// Rounded  like any sample of the pipeline: corners to the subpixel grid, and their depths. The
///          window depth, with the polygon offset, decides which surface is nearer, before it is
///          stored; for mappings that are not projections, the depth along the view decides. Areas
///          follow in binary64. How far the picture is from exact areas of the scene itself:
///          `fathom study antialiasing`.
/// Source   [WA77], [Cat78]
template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles, const Camera& camera,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, PipelineStatistics& statistics);

}  // namespace fathom::pipeline
