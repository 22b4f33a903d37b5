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

std::span<const std::uint32_t> Tile::numbers_of(std::span<const TileEntry> some) {
  std::transform(some.begin(), some.end(), numbers_.begin(),
                 [](const TileEntry& entry) { return entry.number; });
  return std::span(numbers_).first(some.size());
}

void Tile::pack() {
  entries_ = std::vector<TileEntry>();  // {} would keep its memory
  // It was packed before, or is empty. The list may also be just full, of any length.
  if (surfaces_.size() == places_ && places_ <= room + 1) return;
  forget_hidden();
  surfaces_.resize(places_);
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

/// Of a surface that one sample alone shows, q at that sample is all that will be asked for: a constant,
/// with the same bound on its error.
struct SurfaceOfSample {
  double q;
  std::uint64_t tag;
};

template <class List>
std::span<std::byte> bytes_of(List& list) {
  return std::as_writable_bytes(std::span(list));
}

}  // namespace

std::vector<std::uint32_t> Tile::only_samples() const {
  std::vector<std::uint32_t> samples(places_, no_sample);
  for (std::uint32_t i = 0; i < room; ++i) {
    std::uint32_t& sample = samples[place_of(tags_[i])];
    sample = sample == no_sample ? i : several_samples;
  }
  return samples;
}

// What is known of blocks is left out: it is found again.
void Tile::save(files::Bytes& bytes) const {
  const SavedState state{places_, end_of_front_, draws_back_faces_ ? 1U : 0U};
  files::append(bytes, std::as_bytes(std::span(&state, 1)));
  files::append(bytes, std::as_bytes(std::span(q_)));
  files::append(bytes, std::as_bytes(std::span(tags_)));
  std::vector<SurfaceOfSample> of_samples;
  std::vector<TileSurface> others;
  const std::vector<std::uint32_t> only = only_samples();
  for (std::uint32_t place = 0; place < places_; ++place) {
    const TileSurface& surface = surfaces_[place];
    const std::uint32_t sample = only[place];
    if (sample < room) {
      of_samples.push_back({surface.q(column_of(sample), row_of(sample)), surface.tag});
    } else {
      others.push_back(surface);
    }
  }
  files::append(bytes, std::as_bytes(std::span(of_samples)));
  files::append(bytes, std::as_bytes(std::span(others)));
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
  const std::vector<std::uint32_t> only = only_samples();
  const auto is_of_sample = [](std::uint32_t sample) { return sample < room; };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(only, is_of_sample));
  std::vector<SurfaceOfSample> of_samples(count);
  std::vector<TileSurface> others(places_ - count);
  take(bytes_of(of_samples));
  take(bytes_of(others));
  surfaces_.resize(places_);
  auto next_of_sample = of_samples.cbegin();
  auto next_other = others.cbegin();
  for (std::uint32_t place = 0; place < places_; ++place) {
    if (is_of_sample(only[place])) {
      surfaces_[place] = {next_of_sample->q, 0, 0, next_of_sample->tag};
      ++next_of_sample;
    } else {
      surfaces_[place] = *next_other++;
    }
  }
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
