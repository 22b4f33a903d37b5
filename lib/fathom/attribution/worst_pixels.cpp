#include "fathom/attribution/worst_pixels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

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

double relative_error(double truth, double other) {
  if (std::isinf(truth) || std::isinf(other)) return 0;
  return std::abs(other - truth) / truth;
}

}  // namespace

std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count) {
  const StandardArithmetic standard;
  using Rank = std::pair<int, double>;
  std::vector<std::pair<Rank, std::size_t>> ranked;
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    const int rank = urgency(found.classes[i]);
    if (rank > 0) ranked.push_back({{rank, relative_error(truth.depths[i], other.depths[i])}, i});
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

}  // namespace fathom::attribution
