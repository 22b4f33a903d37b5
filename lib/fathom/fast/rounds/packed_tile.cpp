#include "fathom/fast/rounds/packed_tile.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace fathom::fast {

namespace {

constexpr std::uint32_t several_samples = Tile::samples, no_sample = Tile::samples + 1;

bool is_of_sample(std::uint32_t sample) {
  return sample < Tile::samples;
}

/// Besides samples and surfaces.
struct SavedState {
  std::uint32_t places, end_of_front, draws_back_faces;
};

/// Of a surface that one sample alone shows, q at that sample is all that will be asked for: a
/// constant, with the same bound on its error.
struct SurfaceOfSample {
  double q;
  std::uint64_t tag;
};

/// For each place, the one sample that shows its surface; greater numbers where none does, or
/// several.
std::vector<std::uint32_t> only_samples(const Tile& tile, std::uint32_t places) {
  std::vector<std::uint32_t> samples(places, no_sample);
  for (std::uint32_t i = 0; i < Tile::samples; ++i) {
    std::uint32_t& sample = samples[Tile::place_of(tile.tags()[i])];
    sample = sample == no_sample ? i : several_samples;
  }
  return samples;
}

}  // namespace

// What is known of blocks is left out: it is found again.
void save(const Tile& tile, files::Bytes& bytes) {
  const std::uint32_t places = tile.end_of_places();
  const SavedState state{places, tile.end_of_front(), tile.draws_back_faces() ? 1U : 0U};
  files::append(bytes, std::as_bytes(std::span(&state, 1)));
  files::append(bytes, std::as_bytes(std::span(tile.q(), Tile::samples)));
  files::append(bytes, std::as_bytes(std::span(tile.tags(), Tile::samples)));
  std::vector<SurfaceOfSample> of_samples;
  std::vector<TileSurface> others;
  const std::vector<std::uint32_t> only = only_samples(tile, places);
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

void restore(const ReadSaved& read, Tile& tile) {
  std::uint64_t offset = 0;
  const auto take = [&]<class T>(std::span<T> list) {
    read(offset, std::as_writable_bytes(list));
    offset += list.size_bytes();
  };
  SavedState state{};
  take(std::span(&state, 1));
  take(std::span(tile.q(), Tile::samples));
  take(std::span(tile.tags(), Tile::samples));
  const std::vector<std::uint32_t> only = only_samples(tile, state.places);
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

}  // namespace fathom::fast
