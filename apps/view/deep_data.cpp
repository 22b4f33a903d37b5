#include "apps/view/deep_data.h"

#include <array>
#include <bit>
#include <limits>
#include <numeric>

namespace fathom::view {
namespace {

using Words = std::vector<std::uint32_t>;

std::array<std::uint32_t, 5> words_of(const DeepSample& sample) {
  return {std::bit_cast<std::uint32_t>(sample.Z), std::bit_cast<std::uint32_t>(sample.ZBack),
          std::bit_cast<std::uint32_t>(sample.area), std::bit_cast<std::uint32_t>(sample.A),
          sample.id};
}

std::size_t sum_of(const DeepMap& deep, std::size_t first, std::size_t end) {
  const auto at = [&](std::size_t k) {
    return deep.counts.begin() + static_cast<std::ptrdiff_t>(k);
  };
  return std::accumulate(at(first), at(end), std::size_t{0});
}

/// A channel that holds `background` so far.
template <class T>
Samples<T>& add_channel(DepthMap& map, const char* name, T background) {
  const std::size_t pixels = std::size_t{map.width} * map.height;
  map.channels.push_back({name, Samples<T>(pixels, background)});
  return std::get<Samples<T>>(map.channels.back().values);
}

}  // namespace

DepthMap flat_map(const DeepMap& deep) {
  constexpr float none = std::numeric_limits<float>::infinity();
  DepthMap map = deep.description;
  map.channels.reserve(5);  // references to channels stay
  auto &depth = add_channel(map, "Z", none), &back = add_channel(map, "ZBack", none);
  auto& coverage = add_channel(map, "A", 0.0F);
  auto& count = add_channel(map, "samples", 0.0F);
  auto& id = add_channel(map, "id", no_surface);
  std::size_t next = 0;
  for (std::size_t k = 0; k < deep.counts.size(); ++k) {
    const std::size_t first = next, end = next + deep.counts[k];
    count[k] = static_cast<float>(deep.counts[k]);
    if (first != end) {
      depth[k] = deep.samples[first].Z;
      back[k] = deep.samples[first].ZBack;
      id[k] = deep.samples[first].id;
    }
    double covered = 0;
    for (; next < end; ++next) covered += static_cast<double>(deep.samples[next].area);
    coverage[k] = static_cast<float>(covered);
  }
  return map;
}

void write_samples(const DeepMap& deep, const TilePlace& tile, const std::string& prefix,
                   const std::string& end, const Sink& sink) {
  const std::uint32_t width = deep.description.width;
  std::array<Words, 5> planes;
  const std::size_t first = std::size_t{tile.y} * width + tile.x;
  std::size_t next = sum_of(deep, 0, first);
  for (std::uint32_t row = 0; row < tile.rows; ++row) {
    const std::size_t from = first + std::size_t{row} * width, to = from + tile.columns;
    const std::size_t after = next + sum_of(deep, from, to);
    for (; next < after; ++next) {
      const auto words = words_of(deep.samples[next]);
      for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        planes[plane].push_back(words[plane]);
      }
    }
    if (row + 1 < tile.rows) next += sum_of(deep, to, from + width);
  }
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    sink(script_text(prefix + std::to_string(plane) + end, packed(planes[plane])));
  }
}

}  // namespace fathom::view
