#include "fathom/numeric/certified_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

constexpr double u = unit_roundoff<double>;

}  // namespace

// With x = fl(…) the rounded result, |x − exact| ≤ u·|x| + 2⁻¹⁰⁷⁴ for each operation of IEEE 754;
// the errors of the operands are carried to first order and beyond without dropping anything. The
// bound itself is computed with at most 6 roundings of non-negative numbers. Each rounding may make
// it too small by a factor 1 − u; the factor bound_rounding compensates for all of them.
Certified<double> operator+(const Certified<double>& a, const Certified<double>& b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + u * std::abs(value) + most_underflow) * bound_rounding};
}

Certified<double> operator*(const Certified<double>& a, const Certified<double>& b) {
  const double value = a.value * b.value;
  return {value, (std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                  u * std::abs(value) + most_underflow) *
                     bound_rounding};
}

// (A / B) − (a / b) = ((A − a) − (a / b)·(B − b)) / B, and |B| ≥ |b| − error of b. The quotient
// a / b lies within u·|q| + 2⁻¹⁰⁷⁴ of q = fl(a / b).
Certified<double> operator/(const Certified<double>& a, const Certified<double>& b) {
  const double least = std::abs(b.value) * (1 - 4 * u) - b.error;
  if (!(least > 0)) return {0, std::numeric_limits<double>::infinity()};
  const double q = a.value / b.value;
  const double size = std::abs(q) * (1 + 4 * u) + most_underflow;
  return {q, ((a.error + size * b.error) / least + u * size + most_underflow) * bound_rounding};
}

// |√X − √x| = |X − x| / (√X + √x) ≤ error of x / √x, and √x is within u of r = fl(√x).
Certified<double> sqrt(const Certified<double>& x) {
  if (certain_sign(x) != Sign::positive) return {0, std::numeric_limits<double>::infinity()};
  const double r = std::sqrt(x.value);
  return {r, (x.error / (r * (1 - 4 * u)) + u * r) * bound_rounding};
}

Interval enclose(const Certified<double>& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(x.error < infinity)) return {-infinity, infinity};
  return {std::nextafter(x.value - x.error, -infinity),
          std::nextafter(x.value + x.error, infinity)};
}

std::optional<float> settled_binary32(const Certified<double>& not_negative) {
  const Interval around = enclose(not_negative);
  const auto low = static_cast<float>(std::max(0.0, around.lower));
  const auto high = static_cast<float>(around.upper);
  if (low != high) return std::nullopt;
  return low;
}

}  // namespace fathom
