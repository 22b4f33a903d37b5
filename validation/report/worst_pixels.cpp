#include "validation/report/worst_pixels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fathom::validation {
namespace {

using attribution::PixelClass;

/// Classes in the order in which they are looked at; 0: not at all.
int urgency(PixelClass c) {
  switch (c) {
    case PixelClass::unexplained:
      return 4;
    case PixelClass::convention:
      return 3;
    case PixelClass::missed:
      return 2;
    case PixelClass::equal:
      return 0;
    default:
      return 1;
  }
}

double relative_error(const ValidationCase& c, std::size_t i) {
  const double truth = c.truth->depths[i], other = c.other.depths[i];
  if (std::isinf(truth) || std::isinf(other)) return 0;
  return std::abs(other - truth) / truth;
}

}  // namespace

std::vector<std::size_t> worst_pixels(const ValidationCase& c, std::size_t count) {
  using Rank = std::pair<int, double>;
  std::vector<std::pair<Rank, std::size_t>> ranked;
  for (std::size_t i = 0; i < c.attribution.classes.size(); ++i) {
    const int rank = urgency(c.attribution.classes[i]);
    if (rank > 0) ranked.push_back({{rank, relative_error(c, i)}, i});
  }
  count = std::min(count, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                    ranked.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  std::vector<std::size_t> worst;
  for (std::size_t i = 0; i < count; ++i) worst.push_back(ranked[i].second);
  return worst;
}

}  // namespace fathom::validation
