#include "fathom/fast/coverage/tile_functions.h"

#include <algorithm>
#include <limits>

#include "fathom/fast/setup_bounds.h"
#include "fathom/fast/tile.h"

namespace fathom::fast {

// The bound of certified_edges() in setup-inl.h, for coordinates relative to the tile; 10uL²
// more for adding half a pixel's change (values_in_pixel()), of a magnitude of at most 2L.
std::array<UncertainHalfPlane, 3> edges_over_tile(const std::array<ImageVertex, 3>& corners,
                                                  const PixelBox& tile) {
  std::array<SquarePoint, 3> p{};
  double L = Tile::size, e = 0;
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

// The functions of exact_setup() are relative to the sample of the tile's first pixel, half a pixel
// from its corner: c moves by (a + b)/2. Their bounds hold for any point up to 8 pixels beyond the
// tile. The additional half of a bound covers the further roundings: of c, of half a pixel's change
// that values_in_pixel() subtracts, and of what TileCoverage::add_to_union() adds
// (validation/proofs/shape_edges.gappa.in). Ends of the range are known up to the next number;
// their part of a sum is rounded five times, which range_end_rounding covers (shape_q.gappa.in).
TileFunctions functions_over_tile(const TriangleSetup& s, const DepthRange& range) {
  TileFunctions over;
  const auto add = [&](double a, double b, double c, double error) {
    over.functions[over.count++] = {a, b, c - (a + b) / 2, setup_bounds::shape_share * error};
  };
  for (std::size_t k = 0; k < 3; ++k) add(s.edge_a[k], s.edge_b[k], s.edge_c[k], s.edge_error);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (range.inside_greatest < infinity) {
    const double doubt = std::abs(range.outside_greatest - range.inside_greatest);
    add(-s.q_a, -s.q_b, range.inside_greatest - s.q_c,
        2 * s.q_error + 2 * doubt +
            setup_bounds::range_end_rounding * std::abs(range.inside_greatest));
  }
  if (range.inside_least > -infinity) {
    const double doubt = std::abs(range.inside_least - range.outside_least);
    add(s.q_a, s.q_b, s.q_c - range.inside_least,
        2 * s.q_error + 2 * doubt +
            setup_bounds::range_end_rounding * std::abs(range.inside_least));
  }
  return over;
}

}  // namespace fathom::fast
