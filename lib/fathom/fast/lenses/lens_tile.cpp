#include "fathom/fast/lenses/lens_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/fast/setup/setup_bounds.h"

namespace fathom::fast {

float LensTile::farthest() {
  return *std::ranges::min_element(tile_.farthest());
}

// The decisions of Tile::settle() at a place of the window; the bounds hold there, as those of the
// setup cover the error of the place. What they leave open is decided along the exact ray.
void LensTile::settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::size_t i,
                      const LensContext& context) {
  if (std::isnan(places_.x[i])) return;  // no ray
  RenderStatistics& statistics = context.window.statistics;
  ++statistics.samples_in_binary64;
  const std::uint32_t column = tile_.area().first_column + Tile::column_of(i);
  const std::uint32_t row = tile_.area().first_row + Tile::row_of(i);
  context.window.note_doubt(column, row);
  const double x = where_.x(places_.x[i]), y = where_.y(places_.y[i]);
  double least_edge = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least_edge = std::min(least_edge, setup.edge_c[k] + setup.edge_a[k] * x + setup.edge_b[k] * y);
  }
  if (least_edge < -setup.edge_error) return;
  std::optional<lens::ExactDirection> ray;
  const auto direction = [&]() -> const lens::ExactDirection& {
    if (!ray) ray = context.preimages.of_pixel(column, row);
    return *ray;
  };
  if (!(least_edge > setup.edge_error)) {
    if (!context.referee.covers(setup.number, direction(), statistics)) return;
  }
  const double q = setup.q_c + setup.q_a * x + setup.q_b * y;
  if (test_range) {
    const DepthRange& range = context.window.range;
    const double error = setup_bounds::q_moves * setup.q_error;
    if (range.certainly_misses(q - error, q + error)) return;
    if (!range.certainly_contains(q - error, q + error)) {
      if (!context.referee.is_in_range(setup.number, direction(), statistics)) return;
    }
  }
  ++statistics.samples_covered;
  const TileSurface& other = tile_.surface_at(i);
  const double d = q - other.q(x, y);
  const double sum = setup.q_error + other.error();
  if (d < -sum) return;
  if (!(d > sum) && other.number() != no_surface) {
    if (!context.referee.hides(setup.number, other.number(), direction(), statistics)) return;
  }
  tile_.q()[i] = static_cast<float>(q);
  tile_.tags()[i] = tag;
}

}  // namespace fathom::fast
