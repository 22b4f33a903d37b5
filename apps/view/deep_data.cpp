#include "apps/view/deep_data.h"

#include <array>
#include <bit>
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

}  // namespace

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
