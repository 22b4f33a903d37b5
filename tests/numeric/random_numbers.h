#pragma once

#include <gmp.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "fathom/numeric/ratio.h"

namespace fathom::testing {

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

}  // namespace fathom::testing
