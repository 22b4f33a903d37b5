#pragma once

#include <arb.h>

#include <cmath>

#include "fathom/numeric/dyadic.h"

/// Balls of Arb, for the oracle: arithmetic that shares nothing with the library.
namespace fathom::oracle {

/// A real number known up to a radius, in 640 bits.
class ArbBall {
 public:
  static constexpr slong bits = 640;

  ArbBall() { arb_init(value_); }
  ArbBall(double x) : ArbBall() { arb_set_d(value_, x); }
  ArbBall(const Dyadic& x) : ArbBall() {
    fmpz_t significand, exponent;
    fmpz_init(significand);
    fmpz_init_set_si(exponent, x.exponent());
    fmpz_set_mpz(significand, x.significand());
    arb_set_fmpz_2exp(value_, significand, exponent);
    fmpz_clear(significand);
    fmpz_clear(exponent);
  }
  ArbBall(const ArbBall& other) : ArbBall() { arb_set(value_, other.value_); }
  ArbBall& operator=(const ArbBall& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  ~ArbBall() { arb_clear(value_); }

  friend ArbBall operator+(const ArbBall& a, const ArbBall& b) { return of(arb_add, a, b); }
  friend ArbBall operator-(const ArbBall& a, const ArbBall& b) { return of(arb_sub, a, b); }
  friend ArbBall operator*(const ArbBall& a, const ArbBall& b) { return of(arb_mul, a, b); }
  friend ArbBall operator/(const ArbBall& a, const ArbBall& b) { return of(arb_div, a, b); }

  [[nodiscard]] ArbBall middle() const {
    ArbBall m;
    arb_get_mid_arb(m.value_, value_);
    return m;
  }
  /// The ball of this middle and the radius 2^power.
  [[nodiscard]] ArbBall widened(slong power) const {
    ArbBall wide = middle();
    mag_set_ui_2exp_si(arb_radref(wide.value_), 1, power);
    return wide;
  }
  [[nodiscard]] ArbBall root() const {
    ArbBall r;
    arb_sqrt(r.value_, value_, bits);
    return r;
  }
  [[nodiscard]] bool lies_within(const ArbBall& other) const {
    return arb_contains_interior(other.value_, value_) != 0;
  }
  [[nodiscard]] bool meets(const ArbBall& other) const {
    return arb_overlaps(value_, other.value_) != 0;
  }
  /// −1, 1, or 0 if it is not known.
  [[nodiscard]] int sign() const {
    if (arb_is_positive(value_) != 0) return 1;
    return arb_is_negative(value_) != 0 ? -1 : 0;
  }
  [[nodiscard]] double approximate() const { return arf_get_d(arb_midref(value_), ARF_RND_NEAR); }
  /// The middle, rounded to `precision` bits.
  [[nodiscard]] Dyadic rounded(slong precision) const {
    arf_t x;
    arf_init(x);
    arf_set_round(x, arb_midref(value_), precision, ARF_RND_NEAR);
    fmpz_t m, e;
    fmpz_init(m);
    fmpz_init(e);
    arf_get_fmpz_2exp(m, e, x);
    mpz_t significand;
    mpz_init(significand);
    fmpz_get_mpz(significand, m);
    const Dyadic result = Dyadic::of(significand, fmpz_get_si(e));
    mpz_clear(significand);
    fmpz_clear(m);
    fmpz_clear(e);
    arf_clear(x);
    return result;
  }

  /// The least ball that contains two numbers.
  static ArbBall hull(const ArbBall& low, const ArbBall& high) { return of(arb_union, low, high); }
  /// The distance of a number from the middle.
  [[nodiscard]] double distance_from(double x) const {
    return std::abs((ArbBall(x) - *this).approximate());
  }

  operator arb_ptr() { return value_; }
  operator arb_srcptr() const { return value_; }

 private:
  using Operation = void (*)(arb_t, const arb_t, const arb_t, slong);
  static ArbBall of(Operation operation, const ArbBall& a, const ArbBall& b) {
    ArbBall result;
    operation(result.value_, a.value_, b.value_, bits);
    return result;
  }

  arb_t value_;
};

}  // namespace fathom::oracle
