#pragma once

#include <cstdint>
#include <random>

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

}  // namespace fathom::bench
