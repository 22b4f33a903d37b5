#include "fathom/attribution/faults/pixel_groups.h"

#include <algorithm>

namespace fathom::attribution {

std::vector<std::vector<std::size_t>> pixel_groups(std::uint32_t width, std::uint32_t height,
                                                   const std::function<bool(std::size_t)>& is_one) {
  const std::size_t count = std::size_t{width} * height;
  std::vector<bool> left(count);
  for (std::size_t i = 0; i < count; ++i) left[i] = is_one(i);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t first = 0; first < count; ++first) {
    if (!left[first]) continue;
    left[first] = false;
    std::vector<std::size_t>& group = groups.emplace_back(1, first);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t x = group[k] % width, y = group[k] / width;
      for (std::size_t row = y == 0 ? 0 : y - 1; row <= std::min<std::size_t>(y + 1, height - 1);
           ++row) {
        for (std::size_t column = x == 0 ? 0 : x - 1;
             column <= std::min<std::size_t>(x + 1, width - 1); ++column) {
          const std::size_t i = row * width + column;
          if (!left[i]) continue;
          left[i] = false;
          group.push_back(i);
        }
      }
    }
  }
  return groups;
}

}  // namespace fathom::attribution
