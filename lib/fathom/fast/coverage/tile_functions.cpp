#include "fathom/fast/coverage/tile_functions.h"

#include <algorithm>
#include <limits>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/setup/setup_bounds.h"

namespace fathom::fast {

// The bound of certified_edges() in setup-inl.h, for coordinates relative to the tile; 10uL²
// more for adding half a pixel's change (values_in_pixel()), of a magnitude of at most 2L.
std::array<UncertainHalfPlane, 3> edges_over_tile(const std::array<ImageVertex, 3>& corners,
                                                  const PixelBox& tile) {
  std::array<SquarePoint, 3> p{};
  double L = TileShape::size, e = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = {corners[k].u - tile.first_column, corners[k].v - tile.first_row};
    L = std::max({L, std::abs(p[k].x), std::abs(p[k].y)});
    e = std::max(e, corners[k].position_error());
  }
  const double error = (setup_bounds::edge_by_corners * (e + unit_roundoff<double> * L) +
                        setup_bounds::shape_rounding * L) *
                       L;
  const auto edge = [&](const SquarePoint& P, const SquarePoint& Q) {
    return UncertainHalfPlane{P.y - Q.y, Q.x - P.x, P.x * Q.y - P.y * Q.x, error};
  };
  return {edge(p[1], p[2]), edge(p[2], p[0]), edge(p[0], p[1])};
}

namespace {

/// An end of the range of depths, and its part of the error of a function over a tile.
struct RangeEnd {
  double q, error;
};

// Wherever exact_setup() knows a bound on q, all terms of q are below greatest_q, and so is |q|. An
// end beyond that has all of them on the same side, wherever it is: 1/far is infinite where far is
// below 2⁻¹⁰²⁴. Such an end moves to beyond_every_q, so that functions and bounds are finite
// numbers and no sum or product of them overflows.
RangeEnd range_end(double inside, double outside) {
  constexpr double beyond_every_q = 0x1p100 * setup_bounds::greatest_q;
  const double q = std::clamp(inside, -beyond_every_q, beyond_every_q);
  const double doubt = std::abs(std::clamp(outside, -beyond_every_q, beyond_every_q) - q);
  return {q, 2 * doubt + setup_bounds::range_end_rounding * std::abs(q)};
}

}  // namespace

// The functions of exact_setup() are relative to the sample of the tile's first pixel, half a pixel
// from its corner: c moves by (a + b)/2. Their bounds hold for any point up to 8 pixels beyond the
// tile. The additional half of a bound covers the further roundings: of c, of half a pixel's change
// that values_in_pixel() subtracts, and of what TileCoverage::add_to_union() adds
// (validation/proofs/edges/shape_edges.gappa.in). Ends of the range are known within their doubt;
// their part of a sum is rounded five times, which range_end_rounding covers (shape_q.gappa.in).
TileFunctions functions_over_tile(const TriangleSetup& s, const DepthRange& range) {
  TileFunctions over;
  const auto add = [&](double a, double b, double c, double error) {
    over.functions[over.count++] = {a, b, c - (a + b) / 2, setup_bounds::shape_share * error};
  };
  for (std::size_t k = 0; k < 3; ++k) add(s.edge_a[k], s.edge_b[k], s.edge_c[k], s.edge_error);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (range.inside_greatest < infinity) {
    const RangeEnd end = range_end(range.inside_greatest, range.outside_greatest);
    add(-s.q_a, -s.q_b, end.q - s.q_c, 2 * s.q_error + end.error);
  }
  if (range.inside_least > -infinity) {
    const RangeEnd end = range_end(range.inside_least, range.outside_least);
    add(s.q_a, s.q_b, s.q_c - end.q, 2 * s.q_error + end.error);
  }
  return over;
}

namespace {

// A sum with factors that are not negative is negative only where one of the two is. With the
// pixel's centre at (x, y), f = centre + a·(x' − x) + b·(y' − y). The sum's own roundings are below
// 16u of the magnitudes of its terms.
bool certainly_negative_sum(const UncertainHalfPlane& f, const UncertainHalfPlane& g, double column,
                            double row) {
  const auto centre = [&](const UncertainHalfPlane& h) {
    return h.c + h.a * (column + 0.5) + h.b * (row + 0.5);
  };
  const double f_centre = centre(f), g_centre = centre(g);
  const auto negative = [&](double f_factor, double g_factor, double f_rest, double g_rest) {
    const double middle = f_factor * f_centre + g_factor * g_centre;
    const double half = std::abs(f_factor * f_rest + g_factor * g_rest) / 2;
    const double error = f_factor * f.error + g_factor * g.error;
    const double size = f_factor * (std::abs(f_centre) + std::abs(f_rest)) +
                        g_factor * (std::abs(g_centre) + std::abs(g_rest));
    return middle + half < -(error + 32 * unit_roundoff<double> * size);
  };
  return (f.a * g.a < 0 && negative(std::abs(g.a), std::abs(f.a), f.b, g.b)) ||
         (f.b * g.b < 0 && negative(std::abs(g.b), std::abs(f.b), f.a, g.a));
}

}  // namespace

bool certainly_misses_pixel(std::span<const UncertainHalfPlane> functions, double column,
                            double row) {
  for (std::size_t i = 1; i < functions.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (certainly_negative_sum(functions[i], functions[k], column, row)) return true;
    }
  }
  return false;
}

}  // namespace fathom::fast
