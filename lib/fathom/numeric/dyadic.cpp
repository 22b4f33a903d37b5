#include "fathom/numeric/dyadic.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "fathom/numeric/big_numbers.h"

namespace fathom {
// A finite binary64 number is an integer below 2⁵³ times a power of two; trailing zeros are dropped
// so that small integers stay small when they are multiplied.
Dyadic::Dyadic(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a Dyadic is made from a finite number");
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto biased_exponent = static_cast<int>(bits >> 52 & 0x7FF);
  std::uint64_t fraction = bits & 0xFFFFFFFFFFFFF;
  if (biased_exponent != 0) fraction |= std::uint64_t{1} << 52;
  if (fraction == 0) {
    mpz_init(significand_);
    return;
  }
  const int trailing_zeros = std::countr_zero(fraction);
  static_assert(sizeof(unsigned long) == 8);
  mpz_init_set_ui(significand_, fraction >> trailing_zeros);
  if (std::signbit(value)) mpz_neg(significand_, significand_);
  exponent_ = (biased_exponent != 0 ? biased_exponent : 1) - 1075 + trailing_zeros;
}

Dyadic Dyadic::of(mpz_srcptr m, long e) {
  Dyadic x;
  mpz_set(x.significand_, m);
  x.exponent_ = e;
  return x;
}

Dyadic::Dyadic(const Dyadic& other) : exponent_(other.exponent_) {
  mpz_init_set(significand_, other.significand_);
}

Dyadic::Dyadic(Dyadic&& other) noexcept : exponent_(other.exponent_) {
  mpz_init(significand_);
  mpz_swap(significand_, other.significand_);
}

Dyadic& Dyadic::operator=(const Dyadic& other) {
  if (this == &other) return *this;
  mpz_set(significand_, other.significand_);
  exponent_ = other.exponent_;
  return *this;
}

Dyadic& Dyadic::operator=(Dyadic&& other) noexcept {
  mpz_swap(significand_, other.significand_);
  std::swap(exponent_, other.exponent_);
  return *this;
}

Dyadic& Dyadic::operator+=(const Dyadic& other) {
  if (other.is_zero()) return *this;
  if (is_zero()) return *this = other;
  if (exponent_ == other.exponent_) {
    mpz_add(significand_, significand_, other.significand_);
  } else if (exponent_ > other.exponent_) {
    mpz_mul_2exp(significand_, significand_, static_cast<mp_bitcnt_t>(exponent_ - other.exponent_));
    mpz_add(significand_, significand_, other.significand_);
    exponent_ = other.exponent_;
  } else {
    Integer aligned;
    mpz_mul_2exp(aligned, other.significand_,
                 static_cast<mp_bitcnt_t>(other.exponent_ - exponent_));
    mpz_add(significand_, significand_, aligned);
  }
  if (is_zero()) exponent_ = 0;
  return *this;
}

Dyadic& Dyadic::operator-=(const Dyadic& other) {
  return *this = *this - other;
}

Dyadic& Dyadic::operator*=(const Dyadic& other) {
  mpz_mul(significand_, significand_, other.significand_);
  exponent_ = is_zero() ? 0 : exponent_ + other.exponent_;
  return *this;
}

namespace {

/// Sets m·2^e to operation(a, b), a sum or a difference of numbers that are not 0. Memory is
/// requested once, with the limb more that GMP's shifts and sums may need each.
template <class Operation>
void combine(mpz_ptr m, long& e, const Dyadic& a, const Dyadic& b, const Operation& operation) {
  e = std::min(a.exponent(), b.exponent());
  const long bits = std::max(a.top(), b.top()) - e;
  mpz_realloc2(m, static_cast<mp_bitcnt_t>(bits + 2L * GMP_NUMB_BITS));
  if (a.exponent() > e) {
    mpz_mul_2exp(m, a.significand(), static_cast<mp_bitcnt_t>(a.exponent() - e));
    operation(m, m, b.significand());
  } else if (b.exponent() > e) {
    mpz_mul_2exp(m, b.significand(), static_cast<mp_bitcnt_t>(b.exponent() - e));
    operation(m, a.significand(), m);
  } else {
    operation(m, a.significand(), b.significand());
  }
  if (mpz_sgn(m) == 0) e = 0;
}

}  // namespace

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  Dyadic sum;
  combine(sum.significand_, sum.exponent_, a, b, mpz_add);
  return sum;
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) {
  if (a.is_zero()) return -b;
  if (b.is_zero()) return a;
  Dyadic difference;
  combine(difference.significand_, difference.exponent_, a, b, mpz_sub);
  return difference;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  Dyadic product;
  mpz_mul(product.significand_, a.significand_, b.significand_);
  product.exponent_ = product.is_zero() ? 0 : a.exponent_ + b.exponent_;
  return product;
}

Dyadic Dyadic::operator-() const {
  Dyadic negated = *this;
  mpz_neg(negated.significand_, negated.significand_);
  return negated;
}

Dyadic Dyadic::scaled(long power) const {
  Dyadic result = *this;
  if (!is_zero()) result.exponent_ += power;
  return result;
}

int compare(const Dyadic& a, const Dyadic& b) {
  const int sign_a = mpz_sgn(a.significand_);
  const int sign_b = mpz_sgn(b.significand_);
  if (sign_a != sign_b) return sign_a < sign_b ? -1 : 1;
  if (sign_a == 0) return 0;
  // The bit lengths settle most comparisons without aligning numbers of very different size.
  const long top_a = a.top(), top_b = b.top();
  if (top_a != top_b) return (top_a < top_b) == (sign_a > 0) ? -1 : 1;
  return static_cast<int>((a - b).sign());
}

// The leading 53 bits give one end (truncation towards zero), the next number away from zero the
// other. Below the normal range the ends are multiples of the least subnormal.
Interval enclose(const Dyadic& x) {
  if (x.is_zero()) return {0, 0};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const long top = x.top();
  double toward_zero;
  bool representable;
  if (top > 1024) {
    toward_zero = std::numeric_limits<double>::max();
    representable = false;
  } else {
    // The place of the last bit kept, in the significand.
    const long last = std::max(0L, std::max(top - 53, -1074L) - x.exponent());
    const long bits = top - x.exponent();
    representable = mpz_scan1(x.significand(), 0) >= static_cast<mp_bitcnt_t>(last);
    toward_zero = last >= bits ? 0
                               : std::ldexp(bits_between(x.significand(), last, bits),
                                            static_cast<int>(x.exponent() + last));
  }
  const double away = representable ? toward_zero : std::nextafter(toward_zero, infinity);
  if (x.sign() == Sign::positive) return {toward_zero, away};
  return {-away, -toward_zero};
}

Dyadic abs(const Dyadic& x) {
  return x.sign() == Sign::negative ? -x : x;
}

std::size_t hash_of(const Dyadic& x) {
  if (x.is_zero()) return 0;
  constexpr std::size_t factor = 0x9E3779B97F4A7C15;
  const mp_bitcnt_t zeros = mpz_scan1(x.significand(), 0);
  Integer odd;
  mpz_tdiv_q_2exp(odd, x.significand(), zeros);
  auto hash = static_cast<std::size_t>(x.exponent() + static_cast<long>(zeros));
  if (x.sign() == Sign::negative) hash = ~hash;
  for (std::size_t i = 0; i < mpz_size(odd); ++i) {
    hash = (hash ^ mpz_getlimbn(odd, static_cast<mp_size_t>(i))) * factor;
    hash ^= hash >> 29;
  }
  return hash;
}

long last_bit(double x) {
  if (x == 0) return bit_of_zero;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const long biased = static_cast<long>(bits >> 52 & 0x7FF);
  const std::uint64_t significand = (bits & 0xFFFFFFFFFFFFF) | std::uint64_t{biased != 0} << 52;
  return std::max(biased, 1L) - 1075 + std::countr_zero(significand);
}

long last_bit(const Dyadic& x) {
  if (x.is_zero()) return bit_of_zero;
  return static_cast<long>(mpz_scan1(x.significand(), 0)) + x.exponent();
}

void divide_by_common_factor(std::span<Dyadic> numbers) {
  long unit = std::numeric_limits<long>::max();
  for (const Dyadic& x : numbers)
    if (!x.is_zero()) unit = std::min(unit, x.exponent());
  Integer integer, divisor;
  for (Dyadic& x : numbers) {
    if (x.is_zero()) continue;
    mpz_mul_2exp(integer, x.significand(), static_cast<mp_bitcnt_t>(x.exponent() - unit));
    mpz_gcd(divisor, divisor, integer);
    x = Dyadic::of(integer);
  }
  for (Dyadic& x : numbers) {
    if (x.is_zero()) continue;
    mpz_divexact(integer, x.significand(), divisor);
    x = Dyadic::of(integer);
  }
}

}  // namespace fathom
