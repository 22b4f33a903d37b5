#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/output/output_merger.h"

/// A pixel's square, divided among the surfaces that are seen in it.
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

/// A triangle as a pixel sees it.
struct PixelSurface {
  std::uint32_t number = 0;
  std::array<PixelForm, 3> edges;  ///< none is negative where the triangle is
  PixelForm nearness;              ///< greater is nearer; affine, as window depth and 1/w are
};

/// What is seen of a surface in a pixel.
struct SeenPart {
  std::uint32_t number;
  double area;          ///< of the pixel's 1
  PixelPoint centroid;  ///< of the area that is seen
};

/// The square as convex pieces, each with the surface that is seen there. A surface that is added
/// takes from each piece what lies within its edges and on the side where it is nearer of the line
/// in which the two planes intersect, so surfaces that penetrate each other or overlap in a cycle
/// are as right as others, and the order in which they come does not matter.
///
/// Rounded  places, to binary64. A line cuts a piece in two that share the places where it does, so
///          the areas of all pieces always add up to 1 up to the rounding of their sum; an edge is
///          off by at most some 2⁻⁵² of a pixel, and the line of two planes by the rounding of
///          their nearness over the slope of its difference.
class PixelPartition {
 public:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  /// The whole square, in which nothing is seen.
  void clear();
  /// `always`: what is added is seen, whatever is nearer (the painter's algorithm). Where two are
  /// equally near, the lower number is seen.
  void add(const PixelSurface& surface, bool always = false);
  /// What is seen, `nothing` included, by number.
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
/// weighted by its visible area and shaded at the centroid of that area (area_sampling.h).
///
/// Rounded  like any sample of the pipeline: corners to the subpixel grid, and their depths. What
///          is nearer is decided by the window depth, with the polygon offset, before it is stored;
///          for mappings that are not projections by the depth along the view. Areas follow in
///          binary64. How far the picture is from exact areas of the scene itself:
///          `fathom study antialiasing`.
/// Source   [WA77], [Cat78]
template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles, const Camera& camera,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, PipelineStatistics& statistics);

}  // namespace fathom::pipeline
