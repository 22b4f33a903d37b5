#include "tests/attribution/halfs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace fathom::test {
namespace {

/// From 0 on, in ascending order, which is that of their bits.
std::vector<double> all_halfs() {
  std::vector<double> halfs;
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    const std::uint32_t exponent = bits >> 10, fraction = bits & 0x3ff;
    const bool is_subnormal = exponent == 0;
    halfs.push_back(std::ldexp(is_subnormal ? fraction : 1024 + fraction,
                               (is_subnormal ? 1 : static_cast<int>(exponent)) - 25));
  }
  return halfs;
}

}  // namespace

double nearest_half(double x) {
  static const std::vector<double> halfs = all_halfs();
  const double size = std::abs(x);
  const auto above = std::lower_bound(halfs.begin(), halfs.end(), size);
  if (above == halfs.begin() || above == halfs.end()) return std::copysign(halfs.front(), x);
  const auto below = above - 1;
  const double up = *above - size, down = size - *below;
  const bool takes_below = down < up || (down == up && (below - halfs.begin()) % 2 == 0);
  return std::copysign(takes_below ? *below : *above, x);
}

}  // namespace fathom::test
