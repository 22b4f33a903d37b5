#pragma once

#include <mpfr.h>

#include "fathom/numeric/dyadic.h"

/// Intervals of MPFR's numbers. Only for .cpp files, of this module and of lens.
namespace fathom {

/// A closed interval that contains an exact number, at any precision.
///
/// Exact    every operation rounds its ends outwards, to the greater precision of its operands.
/// Range    exponents below 2³⁰ in size, MPFR's default. Exponents of a Dyadic may be greater, but
///          the numbers of cameras with lenses stay below.
class BigInterval {
 public:
  /// The narrowest interval of `bits` bits that contains x.
  BigInterval(const Dyadic& x, long bits) : BigInterval(x, x, bits) {}
  /// Contains low and high; low ≤ high.
  BigInterval(const Dyadic& low, const Dyadic& high, long bits);
  BigInterval(const DyadicInterval& x, long bits) : BigInterval(x.low, x.high, bits) {}
  static BigInterval pi(long bits);
  BigInterval(const BigInterval& other);
  BigInterval(BigInterval&& other) noexcept;
  BigInterval& operator=(const BigInterval& other);
  BigInterval& operator=(BigInterval&& other) noexcept;
  ~BigInterval();

  friend BigInterval operator+(const BigInterval& a, const BigInterval& b);
  friend BigInterval operator-(const BigInterval& a, const BigInterval& b);
  friend BigInterval operator*(const BigInterval& a, const BigInterval& b);
  /// Needs    a divisor that does not contain 0.
  friend BigInterval operator/(const BigInterval& a, const BigInterval& b);
  BigInterval operator-() const;
  /// x², which is not negative.
  friend BigInterval square(const BigInterval& x);
  /// Needs    an x that is not negative.
  friend BigInterval sqrt(const BigInterval& x);
  /// The cosine of an angle from 0 to π.
  friend BigInterval cos(const BigInterval& angle);
  /// sin(angle)/angle of an angle from 0 to π; 1 at 0.
  friend BigInterval sinc(const BigInterval& angle);

  /// The sign of all its numbers; Sign::zero if they differ in sign, or are 0.
  [[nodiscard]] Sign sign() const;
  [[nodiscard]] DyadicInterval ends() const;
  /// A number about halfway between the ends.
  [[nodiscard]] Dyadic centre() const;

 private:
  explicit BigInterval(long bits);
  static BigInterval product_around_zero(const BigInterval& a, const BigInterval& b);
  [[nodiscard]] long bits() const { return mpfr_get_prec(low_); }

  mpfr_t low_, high_;
};

}  // namespace fathom
