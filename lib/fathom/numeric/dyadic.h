#pragma once

#include <gmp.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "fathom/numeric/interval.h"

namespace fathom {

/// An exact number m·2^e with integers m, e of any size.
///
/// Every finite binary64 number is one, and they are closed under +, − and ×. All quantities of
/// the specification are dyadic, quotients of dyadics (Ratio), or square roots of such quotients.
/// Not in it: division, and anything rounded; see ratio.h and rounding.h.
class Dyadic {
 public:
  Dyadic() { mpz_init(significand_); }
  /// The number that `value` denotes. Throws std::invalid_argument if it is not finite.
  Dyadic(double value);  // implicit: a double is a dyadic number
  /// m·2^e.
  static Dyadic of(mpz_srcptr m, long e = 0);
  Dyadic(const Dyadic& other);
  Dyadic(Dyadic&& other) noexcept;
  Dyadic& operator=(const Dyadic& other);
  Dyadic& operator=(Dyadic&& other) noexcept;
  ~Dyadic() { mpz_clear(significand_); }

  Dyadic& operator+=(const Dyadic& other);
  Dyadic& operator-=(const Dyadic& other);
  Dyadic& operator*=(const Dyadic& other);
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  Dyadic operator-() const;

  [[nodiscard]] Sign sign() const { return sign_of(mpz_sgn(significand_)); }
  [[nodiscard]] bool is_zero() const { return mpz_sgn(significand_) == 0; }
  /// The number times 2^power.
  [[nodiscard]] Dyadic scaled(long power) const;

  /// m and e. They are not unique: m may be even.
  [[nodiscard]] mpz_srcptr significand() const { return significand_; }
  [[nodiscard]] long exponent() const { return exponent_; }
  /// The t with 2^(t−1) ≤ |x| < 2^t, for a number x that is not 0.
  [[nodiscard]] long top() const {
    return static_cast<long>(mpz_sizeinbase(significand_, 2)) + exponent_;
  }

  friend int compare(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return compare(a, b) == 0; }
  friend bool operator<(const Dyadic& a, const Dyadic& b) { return compare(a, b) < 0; }
  friend bool operator>(const Dyadic& a, const Dyadic& b) { return compare(a, b) > 0; }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return compare(a, b) <= 0; }
  friend bool operator>=(const Dyadic& a, const Dyadic& b) { return compare(a, b) >= 0; }

 private:
  mpz_t significand_;
  long exponent_ = 0;
};

/// The smallest interval of binary64 numbers that contains `x`; a point if x is representable.
Interval enclose(const Dyadic& x);

Dyadic abs(const Dyadic& x);

/// The same for equal numbers, however they are stored.
std::size_t hash_of(const Dyadic& x);

/// n such that the number is a multiple of 2ⁿ, but not of 2ⁿ⁺¹; for zero, a multiple of all,
/// bit_of_zero, which is beyond every other.
inline constexpr long bit_of_zero = 1L << 40;
long last_bit(double x);
long last_bit(const Dyadic& x);

/// Replaces numbers by the least integers with the same ratios and signs: lists that differ by a
/// positive factor become equal. Zeroes stay zeroes.
/// Exact    always.
void divide_by_common_factor(std::span<Dyadic> numbers);

/// A closed interval with exact ends, whose sums and products are exact, too: it grows with what
/// its operands leave open and by no rounding.
struct DyadicInterval {
  Dyadic low, high;

  /// The sign of all its numbers; Sign::zero if they differ in sign, or are 0.
  [[nodiscard]] Sign sign() const {
    if (low.sign() == Sign::positive) return Sign::positive;
    return high.sign() == Sign::negative ? Sign::negative : Sign::zero;
  }
};

/// The smallest interval of binary64 numbers that contains `x`.
inline Interval enclose(const DyadicInterval& x) {
  return {enclose(x.low).lower, enclose(x.high).upper};
}

inline DyadicInterval operator+(const DyadicInterval& a, const DyadicInterval& b) {
  return {a.low + b.low, a.high + b.high};
}

inline DyadicInterval operator*(const Dyadic& a, const DyadicInterval& b) {
  if (a.sign() == Sign::negative) return {a * b.high, a * b.low};
  return {a * b.low, a * b.high};
}

inline DyadicInterval operator*(const DyadicInterval& a, const DyadicInterval& b) {
  const DyadicInterval of_low = a.low * b, of_high = a.high * b;
  return {std::min(of_low.low, of_high.low), std::max(of_low.high, of_high.high)};
}

inline DyadicInterval square(const DyadicInterval& a) {
  DyadicInterval squares{a.low * a.low, a.high * a.high};
  if (squares.high < squares.low) std::swap(squares.low, squares.high);
  if (a.sign() == Sign::zero) squares.low = {};
  return squares;
}

}  // namespace fathom
