#include "fathom/fast/tile.h"

#include <algorithm>
#include <limits>

#include "fathom/fast/setup_bounds.h"
#include "fathom/triangle/sampling.h"

namespace fathom::fast {
using namespace triangle;

namespace {

double local(std::uint32_t position, std::uint32_t origin) {
  return static_cast<double>(position) - origin;
}

}  // namespace

void Tile::start(const PixelBox& area) {
  area_ = area;
  q_.fill(-std::numeric_limits<double>::infinity());
  tags_.fill(no_surface_tag);
  farthest_.fill(-std::numeric_limits<double>::infinity());
  draws_.fill(0);
}

void Tile::set_up_exactly(std::uint32_t number, const PixelBox& box, const Context& context,
                          SetupBatch& batch) {
  ++context.statistics.exact_setups;
  TriangleSetup setup = exact_setup(context.referee.projected(number), context.perspective, box);
  setup.edge_error *= context.switches.widening;
  setup.q_error *= context.switches.widening;
  batch.set(0, setup, box);
}

// The decisions of the vector code (tile_lanes.cpp) once more, each by its own tier. The functions
// may be summed in another order, within the same bounds.
void Tile::settle(const TriangleSetup& setup, bool test_range, std::uint32_t column,
                  std::uint32_t row, const Context& context) {
  context.note_doubt(column, row);
  const std::size_t i = index(column - area_.first_column, row - area_.first_row);
  const double x = local(column, setup.column), y = local(row, setup.row);
  double least_edge = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least_edge = std::min(least_edge, setup.edge_c[k] + setup.edge_a[k] * x + setup.edge_b[k] * y);
  }
  const double q = setup.q_c + setup.q_a * x + setup.q_b * y;
  const std::uint64_t tag = surface_tag(setup.number, setup.q_error);
  RenderStatistics& statistics = context.statistics;
  const ImagePoint s = centre_of_pixel(column, row);
  if (least_edge < -setup.edge_error) return;
  if (!(least_edge > setup.edge_error)) {
    if (!context.referee.covers(setup.number, s, statistics)) return;
  }
  if (test_range) {
    const double error = setup_bounds::q_moves * setup.q_error;
    if (context.range.certainly_misses(q - error, q + error)) return;
    if (!context.range.certainly_contains(q - error, q + error)) {
      if (!context.referee.is_in_range(setup.number, s, statistics)) return;
    }
  }
  ++statistics.samples_covered;
  const double d = q - q_[i], sum = std::bit_cast<double>(tag) + error_at(i);
  if (d < -sum) return;
  const bool certainly_nearer = number_at(i) == no_surface || d > sum;
  if (!certainly_nearer &&
      !context.referee.hides(setup.number, number_at(i), s, context.statistics)) {
    return;
  }
  q_[i] = q;
  tags_[i] = tag;
}

}  // namespace fathom::fast
