#include "apps/view/deep_data.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

namespace fathom::view {
namespace {

using Words = std::vector<std::uint32_t>;

std::array<std::uint32_t, 5> words_of(const DeepSample& sample) {
  return {std::bit_cast<std::uint32_t>(sample.Z), std::bit_cast<std::uint32_t>(sample.ZBack),
          std::bit_cast<std::uint32_t>(sample.area), std::bit_cast<std::uint32_t>(sample.A),
          sample.id};
}

}  // namespace

std::vector<std::size_t> begins_of(const DeepMap& deep) {
  std::vector<std::size_t> begins(deep.counts.size() + 1);
  std::inclusive_scan(deep.counts.begin(), deep.counts.end(), begins.begin() + 1, std::plus<>(),
                      std::size_t{0});
  return begins;
}

std::array<std::string, 5> packed_samples(const DeepMap& deep, std::span<const std::size_t> begins,
                                          const TilePlace& tile) {
  std::array<Words, 5> planes;
  for (std::size_t row = tile.y; row < std::size_t{tile.y} + tile.rows; ++row) {
    const std::size_t first = row * deep.description.width + tile.x;
    for (std::size_t k = begins[first]; k < begins[first + tile.columns]; ++k) {
      const auto words = words_of(deep.samples[k]);
      for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        planes[plane].push_back(words[plane]);
      }
    }
  }
  std::array<std::string, 5> texts;
  std::ranges::transform(planes, texts.begin(), [](const Words& words) { return packed(words); });
  return texts;
}

}  // namespace fathom::view
