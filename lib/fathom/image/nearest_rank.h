#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fathom::image {

/// The ⌈n·p⌉-th of n sorted values, the first for p = 0; p in thousandths, so that n·p is a whole
/// number.
/// Needs    one value at least.
inline double nearest_rank(const std::vector<double>& sorted, std::size_t thousandths) {
  const std::size_t rank = (sorted.size() * thousandths + 999) / 1000;
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace fathom::image
