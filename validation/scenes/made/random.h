#pragma once

#include <array>
#include <cstdint>
#include <random>

/// Numbers that look random, and are the same on every machine.
namespace fathom::bench {

/// The same numbers with every standard library: in [0, 1), multiples of 2⁻⁵³.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  /// A whole number from 0 to count − 1.
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((*this)() * count); }

 private:
  std::mt19937_64 bits_;
};

/// A permutation of 64-bit numbers that spreads every bit over all (the finalizer of SplitMix64).
inline std::uint64_t scattered(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// A smooth random function of space: a random value at each point with whole coordinates, blended
/// between them by 3t² − 2t³. Values lie in [−1, 1); those of different seeds are independent. The
/// same on every machine: sums and products of binary64 numbers, no library function.
/// Needs    coordinates within ±2⁵².
double value_noise(const std::array<double, 3>& p, std::uint64_t seed);

}  // namespace fathom::bench
