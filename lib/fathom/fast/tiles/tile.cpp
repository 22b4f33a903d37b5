#include "fathom/fast/tiles/tile.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "fathom/fast/tiles/settle.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::fast {
using namespace triangle;

namespace {

double local(std::uint32_t position, std::uint32_t origin) {
  return static_cast<double>(position) - origin;
}

}  // namespace

void Tile::start(const PixelBox& area) {
  area_ = area;
  q_.fill(-std::numeric_limits<float>::infinity());
  tags_.fill(no_surface_lane_tag);
  farthest_.fill(-std::numeric_limits<float>::infinity());
  draws_.fill(0);
  if (surfaces_.empty()) {
    surfaces_.push_back({-std::numeric_limits<double>::infinity(), 0, 0, no_surface_tag});
  }
  places_ = 1;
  end_of_front_ = 0;
  draws_back_faces_ = false;
}

std::uint32_t Tile::next_place() {
  if (places_ + SetupBatch::most > most_places) forget_hidden();
  if (places_ + SetupBatch::most > surfaces_.size()) {
    surfaces_.resize(std::max<std::size_t>(2 * surfaces_.size(), 512));
  }
  return places_;
}

void Tile::forget_hidden() {
  std::vector<std::uint32_t> new_place(places_);  // first, whether it is at a sample
  for (const LaneTag tag : tags_) new_place[place_of(tag)] = 1;
  new_place[0] = 0;
  std::uint32_t end = 1, end_of_front = std::min(end_of_front_, end);
  for (std::uint32_t place = 1; place < places_; ++place) {
    if (new_place[place] == 0) continue;
    if (place < end_of_front_) end_of_front = end + 1;
    surfaces_[end] = surfaces_[place];
    new_place[place] = end++;
  }
  for (LaneTag& tag : tags_) tag = (tag & 0xFFFF0000) | new_place[place_of(tag)];
  places_ = end;
  end_of_front_ = end_of_front;
}

void Tile::pack() {
  // It was packed before, or is empty. The list may also be just full, of any length.
  if (surfaces_.size() == places_ && places_ <= samples + 1) return;
  forget_hidden();
  surfaces_.resize(places_);
  surfaces_.shrink_to_fit();
}

std::size_t Tile::bytes() const {
  return sizeof *this + surfaces_.capacity() * sizeof(TileSurface);
}

void Tile::set_surfaces(std::vector<TileSurface> surfaces, std::uint32_t end_of_front,
                        bool draws_back_faces) {
  surfaces_ = std::move(surfaces);
  places_ = static_cast<std::uint32_t>(surfaces_.size());
  end_of_front_ = end_of_front;
  draws_back_faces_ = draws_back_faces;
}

namespace {

/// Decides by the referee.
struct ExactSample {
  std::uint32_t number;
  ImagePoint s;
  const DrawContext& context;

  [[nodiscard]] bool covers() const {
    return context.referee.covers(number, s, context.statistics);
  }
  [[nodiscard]] bool is_in_range() const {
    return context.referee.is_in_range(number, s, context.statistics);
  }
  [[nodiscard]] bool hides(std::uint32_t other) const {
    return context.referee.hides(number, other, s, context.statistics);
  }
};

}  // namespace

void Tile::settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::uint32_t column,
                  std::uint32_t row, const DrawContext& context) {
  ++context.statistics.samples_in_binary64;
  context.note_doubt(column, row);
  const std::uint32_t tile_column = column - area_.first_column, tile_row = row - area_.first_row;
  const TriangleAtSample at{setup,
                            tag,
                            test_range,
                            index(tile_column, tile_row),
                            local(column, setup.column),
                            local(row, setup.row),
                            static_cast<double>(tile_column),
                            static_cast<double>(tile_row)};
  settle_by(ExactSample{setup.number, centre_of_pixel(column, row), context}, at, *this, context);
}

}  // namespace fathom::fast
