#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "fathom/fast/setup/setup_bounds.h"
#include "fathom/fast/tiles/tile.h"

namespace fathom::fast {

/// A triangle at one sample of a tile.
struct TriangleAtSample {
  const TriangleSetup& setup;
  LaneTag tag;
  bool test_range;
  /// The index of the sample; its place from the first sample of the setup, and from the tile's.
  std::size_t i;
  double x, y;
  double tile_x, tile_y;
};

/// Settles the sample by binary64, and where that does not, by the judge's covers(), is_in_range()
/// and hides(number of another triangle), which are exact.
//
// The same decisions as in the vector code (cell_drawing-inl.h), each by its own tier. The
// functions may be summed in another order, within the same bounds.
template <class Judge>
void settle_by(const Judge& judge, const TriangleAtSample& at, Tile& tile,
               const DrawContext& context) {
  const TriangleSetup& setup = at.setup;
  double least_edge = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least_edge =
        std::min(least_edge, setup.edge_c[k] + setup.edge_a[k] * at.x + setup.edge_b[k] * at.y);
  }
  const double q = setup.q_c + setup.q_a * at.x + setup.q_b * at.y;
  if (least_edge < -setup.edge_error) return;
  if (!(least_edge > setup.edge_error) && !judge.covers()) return;
  if (at.test_range) {
    const double error = setup_bounds::q_moves * setup.q_error;
    if (context.range.certainly_misses(q - error, q + error)) return;
    if (!context.range.certainly_contains(q - error, q + error) && !judge.is_in_range()) return;
  }
  ++context.statistics.samples_covered;
  const TileSurface& other = tile.surface_at(at.i);
  const double d = q - other.q(at.tile_x, at.tile_y);
  const double sum = setup.q_error + other.error();
  if (d < -sum) return;
  if (!(d > sum) && other.number() != no_surface && !judge.hides(other.number())) return;
  tile.q()[at.i] = static_cast<float>(q);
  tile.tags()[at.i] = at.tag;
}

}  // namespace fathom::fast
