#pragma once

#include <array>
#include <cstdint>

namespace fathom::bench {

/// A smooth random function of space: a random value at each point with whole coordinates, blended
/// between them by 3t² − 2t³. Values lie in [−1, 1); those of different seeds are independent. The
/// same on every machine: sums and products of binary64 numbers, no library function.
/// Needs    coordinates within ±2⁵².
double value_noise(const std::array<double, 3>& p, std::uint64_t seed);

}  // namespace fathom::bench
