#pragma once

#include <array>
#include <functional>
#include <optional>

#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/pixels.h"
#include "fathom/pipeline/scan/polygon_tests.h"

/// Triangles by edge functions, over an arithmetic: e_A(P) is twice the signed area of P, B, C and
/// so on around, signed so that the inside of every edge is positive in either winding. A centre on
/// an edge belongs to the triangle if that is a left or a top edge (specification, section 4).
/// Source   [Pin88]
namespace fathom::pipeline {

/// Whose the centres on an edge are.
enum class EdgeRule {
  top_left,  ///< a left or top edge's: of two triangles that share an edge, one has them
  closed,    ///< every edge's, as by the textbooks' `>= 0`: both triangles have them
};

/// An edge function, a·x + b·y + c: a point is inside if it is positive, or if it is zero on an
/// edge that includes zero.
template <class Number>
struct EdgeFunction {
  Number a, b, c;
  bool left_or_top;
  bool takes_zero;

  [[nodiscard]] Number at(const Number& x, const Number& y) const { return a * x + b * y + c; }
  [[nodiscard]] bool contains(const Number& value) const {
    return value > Number(0) || (takes_zero && value == Number(0));
  }
};

template <class Number>
struct EdgeTriangle {
  std::array<EdgeFunction<Number>, 3> edges;  ///< opposite A, B, C
  Number twice_area;                          ///< positive
  bool turned;  ///< the corners run clockwise as seen (y down), so signs were reversed
};

/// nullopt if the area is zero: such a triangle covers nothing.
template <class Number>
std::optional<EdgeTriangle<Number>> edge_functions(const std::array<Point<Number>, 3>& corners,
                                                   EdgeRule rule = EdgeRule::top_left);

/// The bounding box as pixels: the pixels of the window that it touches.
template <class Number>
PixelWindow bounding_box(const std::array<Point<Number>, 3>& corners, const PixelWindow& window);

/// A pixel whose centre the triangle covers, with its barycentric weights, which are ratios of
/// areas.
template <class Number>
struct CoveredPixel {
  Pixel pixel;
  std::array<Number, 3> edges;  ///< e_A, e_B, e_C
  std::array<Number, 3> barycentric;
};

/// Tests every centre of the bounding box, row by row.
/// Exact    over Exact. In floating point, for demonstration: neighbours across an edge evaluate it
///          from different corners, and can both take a centre near it, or neither.
template <class Number>
void rasterize_triangle(const std::array<Point<Number>, 3>& corners, const PixelWindow& window,
                        const std::function<void(const CoveredPixel<Number>&)>& visit,
                        EdgeRule rule = EdgeRule::top_left);

}  // namespace fathom::pipeline
