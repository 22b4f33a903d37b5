#pragma once

#include <gmp.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "fathom/numeric/double_word.h"
#include "fathom/numeric/ratio.h"

namespace fathom::checks {

/// A finite double of any exponent, subnormals and zeros among them.
inline double any_double(std::mt19937_64& random) {
  for (;;) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

/// An integer of few bits times a power of two near 1: sums and products of such tie often.
inline double few_bits(std::mt19937_64& random) {
  const int significand = static_cast<int>(random() % 65) - 32;
  return std::ldexp(significand, static_cast<int>(random() % 9) - 4);
}

inline void set(mpq_t q, double value) {
  mpq_set_d(q, value);
}

/// x as GMP's own rational.
inline void set(mpq_t q, const Dyadic& x) {
  mpq_set_z(q, x.significand());
  if (x.exponent() >= 0) {
    mpq_mul_2exp(q, q, static_cast<mp_bitcnt_t>(x.exponent()));
  } else {
    mpq_div_2exp(q, q, static_cast<mp_bitcnt_t>(-x.exponent()));
  }
}

inline void set(mpq_t q, const Ratio& x) {
  mpq_t d;
  mpq_init(d);
  set(d, x.denominator);
  set(q, x.numerator);
  mpq_div(q, q, d);
  mpq_clear(d);
}

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  /// Uniform in (−1, 1), all 53 bits used.
  double unit() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
  /// A magnitude from all over, some of few bits, some 0, some near a power of two.
  double wild(int exponents) {
    const double size = std::ldexp(1, below(2 * exponents + 1) - exponents);
    switch (below(5)) {
      case 0:
        return 0;
      case 1:
        return (below(17) - 8) * size;
      case 2:
        return std::nextafter(size, 0) * (below(2) ? 1 : -1);
      default:
        return unit() * size;
    }
  }
  /// Double-words: full ones, some of one word, some near a power of two.
  WordPair word_pair() {
    const double hi = below(4) == 0 ? 1 + std::ldexp(below(5) - 2, -52) : unit();
    const double lo = below(8) == 0 ? 0 : unit() * hi * 0x1p-53 * std::ldexp(1, -below(3) * 9);
    return two_sum(std::ldexp(hi, below(9) - 4), lo);
  }

 private:
  std::mt19937_64 random_;
};

/// A number as GMP's own rational, freed at the end.
class Rational {
 public:
  Rational() { mpq_init(q); }
  template <class Number>
  explicit Rational(const Number& x) : Rational() {
    set(q, x);
  }
  ~Rational() { mpq_clear(q); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  mpq_t q;
};

}  // namespace fathom::checks
