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

std::vector<TileSurface> Tile::number_visible() {
  std::vector<std::uint32_t> new_place(places_);
  std::vector<TileSurface> kept;
  kept.reserve(std::min<std::size_t>(places_, room + 1));
  kept.push_back(surfaces_[0]);
  for (LaneTag& tag : tags_) {
    const std::uint32_t place = place_of(tag);
    if (place == 0) continue;
    if (new_place[place] == 0) {
      new_place[place] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(surfaces_[place]);
    }
    tag = (tag & 0xFFFF0000) | new_place[place];
  }
  end_of_front_ = 0;
  places_ = static_cast<std::uint32_t>(kept.size());
  return kept;
}

void Tile::forget_hidden() {
  const std::vector<TileSurface> kept = number_visible();
  std::ranges::copy(kept, surfaces_.begin());
}

std::span<const std::uint32_t> Tile::numbers_of(std::span<const TileEntry> some) {
  std::transform(some.begin(), some.end(), numbers_.begin(),
                 [](const TileEntry& entry) { return entry.number; });
  return std::span(numbers_).first(some.size());
}

void Tile::pack() {
  entries_ = std::vector<TileEntry>();  // {} would keep its memory
  // It was packed before, or is empty. The list may also be just full, of any length.
  if (surfaces_.size() == places_ && places_ <= room + 1) return;
  surfaces_ = number_visible();
  surfaces_.shrink_to_fit();
}

std::size_t Tile::bytes() const {
  return sizeof *this + surfaces_.capacity() * sizeof(TileSurface) +
         entries_.capacity() * sizeof(TileEntry);
}

namespace {

/// Besides samples and surfaces.
struct SavedState {
  std::uint32_t places, end_of_front, draws_back_faces;
};

template <class List>
std::span<std::byte> bytes_of(List& list) {
  return std::as_writable_bytes(std::span(list));
}

}  // namespace

// What is known of blocks is left out: it is found again.
void Tile::save(text::Bytes& bytes) const {
  const SavedState state{places_, end_of_front_, draws_back_faces_ ? 1U : 0U};
  text::append(bytes, std::as_bytes(std::span(&state, 1)));
  text::append(bytes, std::as_bytes(std::span(q_)));
  text::append(bytes, std::as_bytes(std::span(tags_)));
  text::append(bytes, std::as_bytes(std::span(surfaces_).first(places_)));
}

void Tile::restore(const std::function<void(std::uint64_t, std::span<std::byte>)>& read) {
  std::uint64_t offset = 0;
  const auto take = [&](std::span<std::byte> to) {
    read(offset, to);
    offset += to.size();
  };
  SavedState state{};
  take(std::as_writable_bytes(std::span(&state, 1)));
  take(bytes_of(q_));
  take(bytes_of(tags_));
  places_ = state.places;
  end_of_front_ = state.end_of_front;
  draws_back_faces_ = state.draws_back_faces != 0;
  surfaces_.resize(places_);
  take(bytes_of(surfaces_));
}

void Tile::set_up_exactly(std::uint32_t number, const PixelBox& box, const Context& context,
                          std::size_t lane, SetupBatch& batch) {
  ++context.statistics.exact_setups;
  TriangleSetup setup =
      moved_to(context.exact_setups.of(number, context.referee, context.perspective), box);
  setup.edge_error *= context.switches.widening;
  setup.q_error *= context.switches.widening;
  batch.set(lane, setup, box);
}

// The decisions of the vector code (tile_lanes.cpp) once more, each by its own tier. The functions
// may be summed in another order, within the same bounds.
void Tile::settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::uint32_t column,
                  std::uint32_t row, const Context& context) {
  RenderStatistics& statistics = context.statistics;
  ++statistics.samples_in_binary64;
  context.note_doubt(column, row);
  const std::size_t i = index(column - area_.first_column, row - area_.first_row);
  const double x = local(column, setup.column), y = local(row, setup.row);
  double least_edge = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least_edge = std::min(least_edge, setup.edge_c[k] + setup.edge_a[k] * x + setup.edge_b[k] * y);
  }
  const double q = setup.q_c + setup.q_a * x + setup.q_b * y;
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
  const TileSurface& other = surface_at(i);
  const double d = q - other.q(local(column, area_.first_column), local(row, area_.first_row));
  const double sum = setup.q_error + other.error();
  if (d < -sum) return;
  if (!(d > sum) && other.number() != no_surface) {
    if (!context.referee.hides(setup.number, other.number(), s, statistics)) return;
  }
  q_[i] = static_cast<float>(q);
  tags_[i] = tag;
}

}  // namespace fathom::fast
