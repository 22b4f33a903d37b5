#include "fathom/numeric/slerp.h"

#include "fathom/numeric/big_numbers.h"
#include "fathom/numeric/rounding.h"

namespace fathom {
namespace {

constexpr long bits = 320;
constexpr mpfr_rnd_t nearest = MPFR_RNDN;

using Quaternion = std::array<double, 4>;

Dyadic dot(const Quaternion& p, const Quaternion& q) {
  Dyadic sum;
  for (std::size_t i = 0; i < p.size(); ++i) sum += Dyadic(p[i]) * Dyadic(q[i]);
  return sum;
}

void set(BigFloat& result, const Dyadic& x) {
  mpfr_set_z_2exp(result, x.significand(), x.exponent(), nearest);
}

void set_root(BigFloat& result, const Dyadic& x) {
  set(result, x);
  mpfr_sqrt(result, result, nearest);
}

/// sin(share·angle) / (sine·length)
Dyadic weight(const Ratio& share, BigFloat& angle, BigFloat& sine, const Dyadic& squared_length) {
  BigFloat value(bits), other(bits);
  set(value, share.numerator);
  set(other, share.denominator);
  mpfr_div(value, value, other, nearest);
  mpfr_mul(value, value, angle, nearest);
  mpfr_sin(value, value, nearest);
  set_root(other, squared_length);
  mpfr_mul(other, other, sine, nearest);
  mpfr_div(value, value, other, nearest);
  return to_dyadic(value);
}

}  // namespace

std::array<double, 4> slerp(const Quaternion& from, const Quaternion& to, const Ratio& share) {
  const Dyadic pp = dot(from, from), qq = dot(to, to), pq = dot(from, to);
  // |p|²·|q|²·sin²ω
  const Dyadic cross = pp * qq - pq * pq;
  if (share.sign() == Sign::zero || cross.is_zero()) return from;
  const Ratio rest = Ratio(1.0) - share;
  if (rest.sign() == Sign::zero) return to;
  BigFloat angle(bits), sine(bits), length(bits);
  set_root(sine, cross);
  set(length, abs(pq));
  mpfr_atan2(angle, sine, length, nearest);
  set_root(length, pp * qq);
  mpfr_div(sine, sine, length, nearest);
  const Dyadic of_from = weight(rest, angle, sine, pp), of_to = weight(share, angle, sine, qq);
  Quaternion result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Dyadic end = of_to * Dyadic(to[i]);
    result[i] = round_to_binary64(
        Ratio(of_from * Dyadic(from[i]) + (pq.sign() == Sign::negative ? -end : end)));
  }
  return result;
}

}  // namespace fathom
