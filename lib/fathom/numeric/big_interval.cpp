#include "fathom/numeric/big_interval.h"

#include <algorithm>
#include <utility>

#include "fathom/numeric/big_numbers.h"

namespace fathom {
namespace {

/// sin(x)/x, rounded in this direction; 0 ≤ x ≤ π.
void set_sinc(mpfr_ptr result, mpfr_srcptr x, mpfr_rnd_t direction) {
  if (mpfr_zero_p(x) != 0) {
    mpfr_set_ui(result, 1, direction);
    return;
  }
  mpfr_sin(result, x, direction);
  mpfr_div(result, result, x, direction);
}

long greater_precision(mpfr_srcptr a, mpfr_srcptr b) {
  return std::max(mpfr_get_prec(a), mpfr_get_prec(b));
}

void set(mpfr_ptr x, const Dyadic& value, mpfr_rnd_t direction) {
  mpfr_set_z_2exp(x, value.significand(), value.exponent(), direction);
}

bool is_negative(mpfr_srcptr x) {
  return mpfr_sgn(x) < 0;
}

}  // namespace

BigInterval::BigInterval(long bits) {
  mpfr_init2(low_, bits);
  mpfr_init2(high_, bits);
}

BigInterval::BigInterval(const Dyadic& low, const Dyadic& high, long bits) : BigInterval(bits) {
  set(low_, low, MPFR_RNDD);
  set(high_, high, MPFR_RNDU);
}

BigInterval::BigInterval(const BigInterval& other) : BigInterval(other.bits()) {
  mpfr_set(low_, other.low_, MPFR_RNDD);
  mpfr_set(high_, other.high_, MPFR_RNDU);
}

BigInterval::BigInterval(BigInterval&& other) noexcept : BigInterval(MPFR_PREC_MIN) {
  *this = std::move(other);
}

BigInterval& BigInterval::operator=(const BigInterval& other) {
  if (this != &other) *this = BigInterval(other);
  return *this;
}

BigInterval& BigInterval::operator=(BigInterval&& other) noexcept {
  mpfr_swap(low_, other.low_);
  mpfr_swap(high_, other.high_);
  return *this;
}

BigInterval::~BigInterval() {
  mpfr_clear(low_);
  mpfr_clear(high_);
}

BigInterval BigInterval::pi(long bits) {
  BigInterval value(bits);
  mpfr_const_pi(value.low_, MPFR_RNDD);
  mpfr_const_pi(value.high_, MPFR_RNDU);
  return value;
}

BigInterval operator+(const BigInterval& a, const BigInterval& b) {
  BigInterval sum(greater_precision(a.low_, b.low_));
  mpfr_add(sum.low_, a.low_, b.low_, MPFR_RNDD);
  mpfr_add(sum.high_, a.high_, b.high_, MPFR_RNDU);
  return sum;
}

BigInterval operator-(const BigInterval& a, const BigInterval& b) {
  BigInterval difference(greater_precision(a.low_, b.low_));
  mpfr_sub(difference.low_, a.low_, b.high_, MPFR_RNDD);
  mpfr_sub(difference.high_, a.high_, b.low_, MPFR_RNDU);
  return difference;
}

BigInterval BigInterval::operator-() const {
  BigInterval negated(bits());
  mpfr_neg(negated.low_, high_, MPFR_RNDD);
  mpfr_neg(negated.high_, low_, MPFR_RNDU);
  return negated;
}

// Where both factors contain 0 within, there are two candidates for either end.
BigInterval BigInterval::product_around_zero(const BigInterval& a, const BigInterval& b) {
  BigInterval product(greater_precision(a.low_, b.low_)), other(product.bits());
  mpfr_mul(product.low_, a.low_, b.high_, MPFR_RNDD);
  mpfr_mul(other.low_, a.high_, b.low_, MPFR_RNDD);
  mpfr_min(product.low_, product.low_, other.low_, MPFR_RNDD);
  mpfr_mul(product.high_, a.low_, b.low_, MPFR_RNDU);
  mpfr_mul(other.high_, a.high_, b.high_, MPFR_RNDU);
  mpfr_max(product.high_, product.high_, other.high_, MPFR_RNDU);
  return product;
}

// Otherwise the signs decide. With a factor b ≥ 0 the ends of a stay the ends of the product, each
// times the end of b that moves it outwards; with b ≤ 0 they change places. So it is with a ≥ 0.
BigInterval operator*(const BigInterval& a, const BigInterval& b) {
  const bool a_is_mixed = is_negative(a.low_) && !is_negative(a.high_);
  const bool b_is_mixed = is_negative(b.low_) && !is_negative(b.high_);
  if (a_is_mixed && b_is_mixed) return BigInterval::product_around_zero(a, b);
  if (a_is_mixed) return b * a;
  BigInterval product(greater_precision(a.low_, b.low_));
  if (is_negative(a.low_)) {
    mpfr_mul(product.low_, is_negative(b.high_) ? a.high_ : a.low_, b.high_, MPFR_RNDD);
    mpfr_mul(product.high_, is_negative(b.low_) ? a.low_ : a.high_, b.low_, MPFR_RNDU);
  } else {
    mpfr_mul(product.low_, is_negative(b.low_) ? a.high_ : a.low_, b.low_, MPFR_RNDD);
    mpfr_mul(product.high_, is_negative(b.high_) ? a.low_ : a.high_, b.high_, MPFR_RNDU);
  }
  return product;
}

BigInterval operator/(const BigInterval& a, const BigInterval& b) {
  BigInterval inverse(greater_precision(a.low_, b.low_));
  mpfr_ui_div(inverse.low_, 1, b.high_, MPFR_RNDD);
  mpfr_ui_div(inverse.high_, 1, b.low_, MPFR_RNDU);
  return a * inverse;
}

BigInterval square(const BigInterval& x) {
  BigInterval squares(x.bits());
  const bool is_positive = mpfr_sgn(x.low_) >= 0, is_not_positive = mpfr_sgn(x.high_) <= 0;
  const bool low_is_greater = mpfr_cmpabs(x.low_, x.high_) > 0;
  mpfr_sqr(squares.high_, low_is_greater ? x.low_ : x.high_, MPFR_RNDU);
  if (is_positive || is_not_positive) {
    mpfr_sqr(squares.low_, low_is_greater ? x.high_ : x.low_, MPFR_RNDD);
  } else {
    mpfr_set_zero(squares.low_, 1);
  }
  return squares;
}

BigInterval sqrt(const BigInterval& x) {
  BigInterval root(x.bits());
  mpfr_sqrt(root.low_, x.low_, MPFR_RNDD);
  mpfr_sqrt(root.high_, x.high_, MPFR_RNDU);
  return root;
}

BigInterval cos(const BigInterval& angle) {
  BigInterval cosine(angle.bits());
  mpfr_cos(cosine.low_, angle.high_, MPFR_RNDD);
  mpfr_cos(cosine.high_, angle.low_, MPFR_RNDU);
  return cosine;
}

// It falls from 0 to π.
BigInterval sinc(const BigInterval& angle) {
  BigInterval value(angle.bits());
  set_sinc(value.low_, angle.high_, MPFR_RNDD);
  set_sinc(value.high_, angle.low_, MPFR_RNDU);
  return value;
}

Sign BigInterval::sign() const {
  if (mpfr_sgn(low_) > 0) return Sign::positive;
  return mpfr_sgn(high_) < 0 ? Sign::negative : Sign::zero;
}

DyadicInterval BigInterval::ends() const {
  return {to_dyadic(low_), to_dyadic(high_)};
}

Dyadic BigInterval::centre() const {
  BigFloat sum(bits());
  mpfr_add(sum, low_, high_, MPFR_RNDN);
  return to_dyadic(sum).scaled(-1);
}

}  // namespace fathom
