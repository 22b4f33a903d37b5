#include "apps/dataset/counted_mask.h"

#include <algorithm>

#include "fathom/image/depth_map.h"

namespace fathom::app {

CountedMask mask_of(const Samples<std::uint32_t>& objects, std::uint32_t width,
                    std::optional<std::uint32_t> object) {
  CountedMask result;
  result.mask.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (object ? objects[i] != *object : objects[i] == no_surface) continue;
    const auto column = static_cast<long>(i % width), row = static_cast<long>(i / width);
    if (result.count++ == 0) result.first_column = column, result.first_row = row;
    result.mask[i] = 1;
    result.first_column = std::min(result.first_column, column);
    result.last_column = std::max(result.last_column, column);
    result.last_row = row;
  }
  return result;
}

std::vector<std::uint8_t> middle_of(const std::vector<std::uint8_t>& mask, std::uint32_t width,
                                    std::uint32_t height) {
  std::vector<std::uint8_t> middle;
  middle.reserve(std::size_t{width} * height);
  for (std::size_t y = height; y < 2 * std::size_t{height}; ++y) {
    const auto row = mask.begin() + static_cast<long>(y * 3 * width + width);
    middle.insert(middle.end(), row, row + width);
  }
  return middle;
}

}  // namespace fathom::app
