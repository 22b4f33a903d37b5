#include "fathom/area/half_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace fathom {
namespace {

constexpr double u = 0x1p-53;  // unit roundoff
/// More than what underflow can do to a sum of products of numbers below 1: each of fewer than 2⁶
/// operations loses at most 2⁻¹⁰⁷⁴, and so does each coefficient.
constexpr double underflow = 0x1p-1000;

long top_bit(const Dyadic& x) {
  return static_cast<long>(mpz_sizeinbase(x.significand(), 2)) + x.exponent();
}

/// The least e for which all components are below 2^e; 0 if they are 0.
long greatest_exponent(const ExactVector3& l) {
  std::optional<long> top;
  for (const Dyadic& x : l) {
    if (!x.is_zero()) top = std::max(top.value_or(top_bit(x)), top_bit(x));
  }
  return top.value_or(0);
}

/// Whether the lines are one: the same coefficients up to a sign. (Two lines of other coefficients
/// may be one all the same; this is the common case, an edge that two triangles share.)
bool same_coefficients(const HalfPlane& a, const HalfPlane& b) {
  if (&a == &b) return true;
  const auto& x = a.exact();
  const auto& y = b.exact();
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(std::abs(a.approximate()[k]) - std::abs(b.approximate()[k])) >
        0x1p-51 * std::abs(a.approximate()[k])) {
      return false;
    }
  }
  const bool turned = x[0].sign() != y[0].sign() || x[1].sign() != y[1].sign();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(turned ? x[k] == -y[k] : x[k] == y[k])) return false;
  }
  return true;
}

}  // namespace

HalfPlane::HalfPlane(ExactVector3 l) : exact_(std::move(l)), exponent_(greatest_exponent(exact_)) {
  for (std::size_t k = 0; k < 3; ++k) {
    exact_[k] = exact_[k].scaled(-exponent_);
    approximate_[k] = enclose(exact_[k]).lower;
  }
}

// Bounded numbers. With x = fl(…) the rounded result, |x − exact| ≤ u·|x| + 2⁻¹⁰⁷⁴ for each
// operation of IEEE 754; the errors of the operands are carried to first order and beyond without
// being dropped. The bound itself is computed with at most 6 roundings of non-negative numbers,
// each of which may make it too small by a factor 1 − u: the factor `up` makes good for them.
namespace {
constexpr double up = 1 + 0x1p-48;
}

Bounded operator+(const Bounded& a, const Bounded& b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + u * std::abs(value) + underflow) * up};
}

Bounded operator*(const Bounded& a, const Bounded& b) {
  const double value = a.value * b.value;
  return {value, (std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                  u * std::abs(value) + underflow) *
                     up};
}

// (A / B) − (a / b) = ((A − a) − (a / b)·(B − b)) / B, and |B| ≥ |b| − error of b. For q = fl(a /
// b) the quotient a / b lies within u·|q| + 2⁻¹⁰⁷⁴ of it.
Bounded operator/(const Bounded& a, const Bounded& b) {
  const double least = std::abs(b.value) * (1 - 4 * u) - b.error;
  if (!(least > 0)) return {0, std::numeric_limits<double>::infinity()};
  const double q = a.value / b.value;
  const double size = std::abs(q) * (1 + 4 * u) + underflow;
  return {q, ((a.error + size * b.error) / least + u * size + underflow) * up};
}

Interval enclose(const Bounded& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(x.error < infinity)) return {-infinity, infinity};
  return {std::nextafter(x.value - x.error, -infinity),
          std::nextafter(x.value + x.error, infinity)};
}

std::optional<float> settled_binary32(const Bounded& not_negative) {
  const Interval around = enclose(not_negative);
  const auto low = static_cast<float>(std::max(0.0, around.lower));
  const auto high = static_cast<float>(around.upper);
  if (low != high) return std::nullopt;
  return low;
}

Bounded approximate_coefficient(const HalfPlane& l, std::size_t k) {
  return {l.approximate()[k], (2 * u * std::abs(l.approximate()[k]) + underflow) * up};
}

// Coefficients are read with a relative error of at most 2u. Then a product of two has been
// multiplied by at most five factors 1 ± u, the difference by one more; a product of three by at
// most 6 + 2, two sums and the inner difference by three more. Hence the errors 6u and 11u times
// the sum of the products' absolute values, which is itself computed with a relative error below
// 10u: 8 and 16 are enough.
Bounded approximate_turn(const HalfPlane& a, const HalfPlane& b) {
  const auto& x = a.approximate();
  const auto& y = b.approximate();
  const double p = x[0] * y[1], q = x[1] * y[0];
  return {p - q, 8 * u * (std::abs(p) + std::abs(q)) + underflow};
}

Bounded approximate_determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c) {
  const auto& x = a.approximate();
  const auto& y = b.approximate();
  const auto& z = c.approximate();
  double value = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double p = y[i] * z[j], q = y[j] * z[i];
    value += x[k] * (p - q);
    size += std::abs(x[k]) * (std::abs(p) + std::abs(q));
  }
  return {value, 16 * u * size + underflow};
}

Dyadic turn(const HalfPlane& a, const HalfPlane& b) {
  return a.exact()[0] * b.exact()[1] - a.exact()[1] * b.exact()[0];
}

Dyadic determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c) {
  return determinant(a.exact(), b.exact(), c.exact());
}

Sign sign_of_turn(const HalfPlane& a, const HalfPlane& b, TierCounts& counts) {
  const Bounded t = approximate_turn(a, b);
  if (std::abs(t.value) > t.error) {
    ++counts.interval;
    return t.value > 0 ? Sign::positive : Sign::negative;
  }
  ++counts.exact;
  if (same_coefficients(a, b)) return Sign::zero;
  return turn(a, b).sign();
}

Sign sign_of_determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c,
                         TierCounts& counts) {
  const Bounded d = approximate_determinant(a, b, c);
  if (std::abs(d.value) > d.error) {
    ++counts.interval;
    return d.value > 0 ? Sign::positive : Sign::negative;
  }
  ++counts.exact;
  if (same_coefficients(a, b) || same_coefficients(b, c) || same_coefficients(a, c)) {
    return Sign::zero;
  }
  return determinant(a, b, c).sign();
}

bool same_side(const HalfPlane& a, const HalfPlane& b) {
  // Parallel normals: a component that is not zero in one is not zero in the other.
  const std::size_t k = a.exact()[0].is_zero() ? 1 : 0;
  return a.exact()[k].sign() == b.exact()[k].sign();
}

// The place where e and m cross is the point e × m, homogeneous with the weight turn(e, m). There n
// has the value n·(e × m) / turn(e, m) = det(e, m, n) / turn(e, m). The walk along e goes in the
// direction (e_v, −e_u), in which n grows at the rate −turn(e, n). Hence
// τ(n) − τ(m) = det(e, m, n) / (turn(e, m)·turn(e, n)).
Sign compare_crossings(const HalfPlane& e, const HalfPlane& m, const HalfPlane& n,
                       TierCounts& counts) {
  return -sign_of_determinant(e, m, n, counts) * sign_of_turn(e, m, counts) *
         sign_of_turn(e, n, counts);
}

Sign side_of_crossing(const HalfPlane& m, const HalfPlane& e, const HalfPlane& at,
                      TierCounts& counts) {
  return sign_of_determinant(e, at, m, counts) * sign_of_turn(e, at, counts);
}

}  // namespace fathom
