#include "fathom/fast/lenses/stage_starts.h"

#include <cmath>
#include <limits>

#include "fathom/fast/lenses/plane_places.h"
#include "fathom/numeric/dyadic.h"

namespace fathom::fast {
using namespace place_arithmetic;

StageStarts::StageStarts(const lens::Preimages& preimages)
    : stage_(preimages.stage()),
      is_plane_(is_plane(preimages.lens().model)),
      limit_(stage_ != nullptr && stage_->limit ? enclose(*stage_->limit).lower * (1 - disc_room)
                                                : std::numeric_limits<double>::infinity()) {}

void StageStarts::start(const Places::OfTile& places, const ViewAxes& axes) {
  places_ = places;
  axes_ = axes;
  growths_.fill(std::nullopt);
}

lens::StageStart StageStarts::at(std::size_t i) {
  if (stage_ == nullptr) return {};
  const std::uint32_t column = TileShape::column_of(i) / TileShape::block;
  const std::uint32_t row = TileShape::row_of(i) / TileShape::block;
  std::optional<Growth>& growth = growths_[row * TileShape::blocks_of_row + column];
  if (!growth) growth = growth_of(column * TileShape::block, row * TileShape::block);
  const auto [x, y] = start_of(i);
  return {x, y, growth->growth, growth->radius};
}

// The place (x, y) is the direction x·right + y·down + forward. Nothing is proved of the start of a
// fisheye: its angle by binary64's functions.
std::array<double, 2> StageStarts::start_of(std::size_t i) const {
  const double place_x = places_.x[i], place_y = places_.y[i];
  if (is_plane_) return {place_x, place_y};
  std::array<double, 3> d{};
  d[axes_.right.of_camera] = axes_.right.sign * place_x;
  d[axes_.down.of_camera] = axes_.down.sign * place_y;
  d[axes_.forward.of_camera] = axes_.forward.sign;
  const double aside = std::hypot(d[0], d[1]);
  const double factor = aside == 0 ? 1 : std::atan2(aside, d[2]) / aside;
  return {d[0] * factor, d[1] * factor};
}

// Points whose coordinates differ from a start by at most 2·radius, half of ball_share of the box
// around the block's starts, are in a circle of ball_share around it: disc_room holds the circle in
// the disc (lens_disc), as for the certificates of places. Growth is that of the box, widened by
// more. A box and a disc are convex.
StageStarts::Growth StageStarts::growth_of(std::uint32_t first_column,
                                           std::uint32_t first_row) const {
  PlaneBox box;
  for (std::uint32_t row = first_row; row < first_row + TileShape::block; ++row) {
    for (std::uint32_t column = first_column; column < first_column + TileShape::block; ++column) {
      const auto [x, y] = start_of(TileShape::index(column, row));
      if (x == x && y == y) box.add({x, x, y, y});
    }
  }
  const double size = box.size();
  const double x = greatest_size(box.left, box.right), y = greatest_size(box.top, box.bottom);
  if (!(size > 0x1p-400 && size < 0x1p400 && x * x + y * y <= limit_)) return {};
  const double room = ball_share * size;
  const lens::StageBounds bounds =
      lens::bounds_on_box(stage_->numbers, {Interval{box.left - room * up, box.right + room * up},
                                            Interval{box.top - room * up, box.bottom + room * up}});
  return {bounds.growth, room / 4};
}

}  // namespace fathom::fast
