#include "validation/scenes/made/random.h"

#include <cmath>

namespace fathom::bench {
namespace {

/// The value at a point of the lattice.
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  std::uint64_t bits = scattered(scattered(seed) + static_cast<std::uint64_t>(x));
  bits = scattered(bits + static_cast<std::uint64_t>(y));
  bits = scattered(bits + static_cast<std::uint64_t>(z));
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

double blend(double a, double b, double t) {
  return a + (b - a) * (t * t * (3 - 2 * t));
}

}  // namespace

double value_noise(const std::array<double, 3>& p, std::uint64_t seed) {
  std::array<std::int64_t, 3> cell{};
  std::array<double, 3> t{};
  for (int k = 0; k < 3; ++k) {
    cell[k] = static_cast<std::int64_t>(std::floor(p[k]));
    t[k] = p[k] - static_cast<double>(cell[k]);
  }
  const auto along_x = [&](int y, int z) {
    return blend(lattice_value(cell[0], cell[1] + y, cell[2] + z, seed),
                 lattice_value(cell[0] + 1, cell[1] + y, cell[2] + z, seed), t[0]);
  };
  const auto along_y = [&](int z) { return blend(along_x(0, z), along_x(1, z), t[1]); };
  return blend(along_y(0), along_y(1), t[2]);
}

}  // namespace fathom::bench
