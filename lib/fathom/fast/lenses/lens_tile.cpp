#include "fathom/fast/lenses/lens_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fathom/fast/tiles/settle.h"

namespace fathom::fast {

float LensTile::farthest() {
  return *std::ranges::min_element(tile_->farthest());
}

namespace {

/// Decides along the exact ray of a pixel, which is found when it is first asked for.
class ExactRay {
 public:
  ExactRay(std::uint32_t number, std::uint32_t column, std::uint32_t row,
           const LensContext& context)
      : number_(number), column_(column), row_(row), context_(context) {}

  [[nodiscard]] bool covers() const {
    return context_.referee.covers(number_, direction(), context_.window.statistics);
  }
  [[nodiscard]] bool is_in_range() const {
    return context_.referee.is_in_range(number_, direction(), context_.window.statistics);
  }
  [[nodiscard]] bool hides(std::uint32_t other) const {
    return context_.referee.hides(number_, other, direction(), context_.window.statistics);
  }

 private:
  [[nodiscard]] const lens::ExactDirection& direction() const {
    if (!ray_) ray_ = context_.preimages.of_pixel(column_, row_);
    return *ray_;
  }

  std::uint32_t number_, column_, row_;
  const LensContext& context_;
  mutable std::optional<lens::ExactDirection> ray_;
};

}  // namespace

// The bounds of the setup cover the error of the place.
void LensTile::settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::size_t i,
                      const LensContext& context) {
  if (std::isnan(places_.x[i])) return;  // no ray
  ++context.window.statistics.samples_in_binary64;
  const std::uint32_t column = tile_->area().first_column + Tile::column_of(i);
  const std::uint32_t row = tile_->area().first_row + Tile::row_of(i);
  context.window.note_doubt(column, row);
  const double x = where_.x(places_.x[i]), y = where_.y(places_.y[i]);
  settle_by(ExactRay(setup.number, column, row, context), {setup, tag, test_range, i, x, y, x, y},
            *tile_, context.window);
}

}  // namespace fathom::fast
