#include "fathom/fast/rounds/tile_store.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "fathom/threads/threads.h"

namespace fathom::fast {

namespace {

constexpr std::uint32_t several_samples = Tile::samples, no_sample = Tile::samples + 1;

bool is_of_sample(std::uint32_t sample) {
  return sample < Tile::samples;
}

/// The saved state in addition to samples and surfaces.
struct SavedState {
  std::uint32_t places, end_of_front, draws_back_faces;
};

/// A surface that a single sample shows is stored as its q at that sample, a constant, with the
/// same bound on its error: no other value will be needed. It is computed only for samples at
/// pixels.
struct SurfaceOfSample {
  double q;
  std::uint64_t tag;
};

/// For each place, the one sample at a pixel that shows its surface; greater numbers where none
/// does, or several.
std::vector<std::uint32_t> only_samples(const Tile& tile, SamplesLie lie, std::uint32_t places) {
  std::vector<std::uint32_t> samples(places, no_sample);
  if (lie == SamplesLie::anywhere) return samples;
  for (std::uint32_t i = 0; i < Tile::samples; ++i) {
    std::uint32_t& sample = samples[Tile::place_of(tile.tags()[i])];
    sample = sample == no_sample ? i : several_samples;
  }
  return samples;
}

}  // namespace

// The data of blocks is left out, because it can be computed again.
void save(const Tile& tile, SamplesLie samples, files::Bytes& bytes) {
  const std::uint32_t places = tile.end_of_places();
  const SavedState state{places, tile.end_of_front(), tile.draws_back_faces() ? 1U : 0U};
  files::append(bytes, std::as_bytes(std::span(&state, 1)));
  files::append(bytes, std::as_bytes(std::span(tile.q(), Tile::samples)));
  files::append(bytes, std::as_bytes(std::span(tile.tags(), Tile::samples)));
  std::vector<SurfaceOfSample> of_samples;
  std::vector<TileSurface> others;
  const std::vector<std::uint32_t> only = only_samples(tile, samples, places);
  for (std::uint32_t place = 0; place < places; ++place) {
    const TileSurface& surface = tile.surfaces()[place];
    const std::uint32_t sample = only[place];
    if (is_of_sample(sample)) {
      of_samples.push_back({surface.q(Tile::column_of(sample), Tile::row_of(sample)), surface.tag});
    } else {
      others.push_back(surface);
    }
  }
  files::append(bytes, std::as_bytes(std::span(of_samples)));
  files::append(bytes, std::as_bytes(std::span(others)));
}

void restore(const ReadSaved& read, SamplesLie samples, Tile& tile) {
  std::uint64_t offset = 0;
  const auto take = [&]<class T>(std::span<T> list) {
    read(offset, std::as_writable_bytes(list));
    offset += list.size_bytes();
  };
  SavedState state{};
  take(std::span(&state, 1));
  take(std::span(tile.q(), Tile::samples));
  take(std::span(tile.tags(), Tile::samples));
  const std::vector<std::uint32_t> only = only_samples(tile, samples, state.places);
  const auto count = static_cast<std::size_t>(std::ranges::count_if(only, is_of_sample));
  std::vector<SurfaceOfSample> of_samples(count);
  std::vector<TileSurface> others(state.places - count);
  take(std::span(of_samples));
  take(std::span(others));
  std::vector<TileSurface> surfaces(state.places);
  auto next_of_sample = of_samples.cbegin();
  auto next_other = others.cbegin();
  for (std::uint32_t place = 0; place < state.places; ++place) {
    if (is_of_sample(only[place])) {
      surfaces[place] = {next_of_sample->q, 0, 0, next_of_sample->tag};
      ++next_of_sample;
    } else {
      surfaces[place] = *next_other++;
    }
  }
  tile.set_surfaces(std::move(surfaces), state.end_of_front, state.draws_back_faces != 0);
}

namespace {

/// The place of a stored tile: each tile has its own, which takes no space before it is written.
std::uint64_t place_of(std::uint32_t number) {
  return std::uint64_t{number} * Tile::most_packed_bytes;
}

}  // namespace

std::size_t TileStore::most_at_once() const {
  return static_cast<std::size_t>(
      std::max<std::uint64_t>(1, most_bytes_ / 8 / Tile::most_packed_bytes));
}

Tile& TileStore::take(std::uint32_t number) {
  Slot& slot = slots_[number];
  slot.used = rooms_made_;
  slot.is_packed = false;
  if (slot.tile) return *slot.tile;
  slot.tile = std::make_unique_for_overwrite<Tile>();
  slot.tile->start(grid_.area(number));
  if (slot.waits) {
    restore([&](std::uint64_t offset,
                std::span<std::byte> bytes) { file_->read(place_of(number) + offset, bytes); },
            samples_, *slot.tile);
    slot.waits = false;
  }
  const std::lock_guard lock(mutex_);
  in_memory_.push_back(number);
  return *slot.tile;
}

// Tiles that were not taken since the last make_room() are finished or wait for longer: they are
// packed first. Packing the others takes less time than writing any tile, but is useless if tiles
// must be written anyway.
void TileStore::make_room() {
  std::erase_if(in_memory_, [&](std::uint32_t number) { return !slots_[number].tile; });
  const auto is_old = [&](std::uint32_t number) { return slots_[number].used < rooms_made_; };
  const auto taken = std::stable_partition(in_memory_.begin(), in_memory_.end(), is_old);
  const auto old = static_cast<std::size_t>(taken - in_memory_.begin());
  bytes_ = 0;
  for (std::size_t i = 0; i < in_memory_.size(); ++i) {
    Slot& slot = slots_[in_memory_[i]];
    if (i >= old) slot.bytes = slot.tile->bytes();
    bytes_ += slot.bytes;
  }
  ++rooms_made_;
  pack(old);
  if (is_too_much() && most_when_packed() > most_kept()) write_oldest(old);
  pack(in_memory_.size());
  write_oldest(in_memory_.size());
}

std::uint64_t TileStore::most_when_packed() const {
  std::uint64_t bytes = 0;
  for (const std::uint32_t number : in_memory_)
    bytes += std::min(slots_[number].bytes, Tile::most_packed_bytes);
  return bytes;
}

void TileStore::pack(std::size_t end) {
  constexpr std::size_t some = 64;
  std::vector<std::uint32_t> unpacked;
  if (!is_too_much()) return;
  std::copy_if(in_memory_.begin(), in_memory_.begin() + static_cast<std::ptrdiff_t>(end),
               std::back_inserter(unpacked),
               [&](std::uint32_t number) { return !slots_[number].is_packed; });
  for (std::size_t from = 0; from < unpacked.size() && is_too_much(); from += some) {
    const std::size_t to = std::min(unpacked.size(), from + some);
    parallel_for(from, to, [&](std::size_t i) {
      Slot& slot = slots_[unpacked[i]];
      slot.tile->pack();
      slot.is_packed = true;
    });
    for (std::size_t i = from; i < to; ++i) {
      Slot& slot = slots_[unpacked[i]];
      bytes_ -= std::exchange(slot.bytes, slot.tile->bytes());
      bytes_ += slot.bytes;
    }
  }
}

// Writes at most `count` tiles, all of which have been packed.
void TileStore::write_oldest(std::size_t count) {
  if (!is_too_much()) return;
  if (!file_) file_.emplace();
  std::size_t end = 0;
  for (; end < count && is_too_much(); ++end) bytes_ -= slots_[in_memory_[end]].bytes;
  parallel_for(std::size_t{0}, end, [&](std::size_t i) {
    Slot& slot = slots_[in_memory_[i]];
    files::Bytes bytes;
    save(*slot.tile, samples_, bytes);
    file_->write(place_of(in_memory_[i]), bytes);
    slot.tile.reset();
    slot.waits = true;
  });
  in_memory_.erase(in_memory_.begin(), in_memory_.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace fathom::fast
