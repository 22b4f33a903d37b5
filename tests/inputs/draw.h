#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace fathom::checks {

/// Numbers from a generator whose sequence the standard fixes (its distributions are not).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::uint64_t bits() { return random_(); }
  /// For what draws by itself.
  std::mt19937_64& generator() { return random_; }
  bool one_in(int n) { return below(n) == 0; }
  int between(int least, int greatest) { return least + below(greatest - least + 1); }
  double sign() { return one_in(2) ? 1 : -1; }
  /// In [0, 1), with 53 bits.
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double within(double limit) { return (2 * unit() - 1) * limit; }
  /// A number of few bits of a magnitude of at most `limit`, which is a power of two.
  double few_bits(double limit) { return between(-16, 16) * (limit / 16); }
  /// ±(1 to 2)·2^e.
  double of_exponent(int e) { return sign() * std::ldexp(one_in(3) ? 1 : 1 + unit(), e); }
  /// x moved by at most `steps` binary64 numbers.
  double nudged(double x, int steps) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int k = below(steps + 1); k > 0; --k)
      x = std::nextafter(x, one_in(2) ? infinity : -infinity);
    return x;
  }
  /// One of an array.
  template <class T, std::size_t n>
  const T& one_of(const T (&choices)[n]) {
    return choices[random_() % n];
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace fathom::checks
