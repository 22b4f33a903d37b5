#include "fathom/lens/angle_polynomial.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "fathom/lens/root_direction.h"
#include "fathom/numeric/big_interval.h"
#include "fathom/numeric/exact_polynomial.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

std::array<Dyadic, 6> coefficients_of(const Lens& lens) {
  std::array<Dyadic, 6> coefficients;
  for (std::size_t i = 0; i < coefficients.size(); ++i) coefficients[i] = lens.distortion[i];
  return coefficients;
}

/// The greatest binary64 number r such that θ' > 0 up to r. The first coefficient of θ' that is not
/// 0 is positive; the powers of r before it change no sign.
double end_of_growth(const std::array<Dyadic, 6>& coefficients) {
  std::vector<Dyadic> slope;
  for (std::size_t i = 1; i < coefficients.size(); ++i)
    if (!slope.empty() || !coefficients[i].is_zero())
      slope.push_back(coefficients[i] * Dyadic(static_cast<double>(i)));
  return greatest_before_positive_root(ExactPolynomial(slope))
      .value_or(std::numeric_limits<double>::max());
}

}  // namespace

AnglePolynomial::AnglePolynomial(const Lens& lens)
    : coefficients_(coefficients_of(lens)), end_(end_of_growth(coefficients_)) {
  if (is_below_pi(end_)) return;
  auto inside = std::bit_cast<std::uint64_t>(0.0), outside = std::bit_cast<std::uint64_t>(end_);
  while (outside - inside > 1) {
    const std::uint64_t between = inside + (outside - inside) / 2;
    (is_below_pi(std::bit_cast<double>(between)) ? inside : outside) = between;
  }
  end_ = std::bit_cast<double>(inside);
}

// θ is rational there, so it is never π.
bool AnglePolynomial::is_below_pi(double r) const {
  Dyadic angle;
  for (std::size_t i = coefficients_.size(); i-- > 0;) angle = angle * Dyadic(r) + coefficients_[i];
  for (long bits = 128;; bits *= 2) {
    const Sign sign = (BigInterval::pi(bits) - BigInterval(angle, bits)).sign();
    if (sign != Sign::zero) return sign == Sign::positive;
  }
}

double AnglePolynomial::at(double r) const {
  double angle = 0;
  for (std::size_t i = coefficients_.size(); i-- > 0;)
    angle = angle * r + enclose(coefficients_[i]).lower;
  return angle;
}

double AnglePolynomial::radius_at(double angle) const {
  if (!(at(end_) > angle)) return end_;
  double inner = 0, outer = end_;
  constexpr int steps = 2000;  // from the greatest binary64 number
  for (int i = 0; i < steps; ++i) {
    const double middle = inner + (outer - inner) / 2;
    if (!(inner < middle && middle < outer)) break;
    (at(middle) > angle ? outer : inner) = middle;
  }
  return inner;
}

// With n = y.a² + y.b² and d = y.c², r is √n/y.c. Times d²·y.c, θ − angle is the sum of
// (p0·d² + p2·n·d + p4·n² − angle·d²)·y.c and (p1·d² + p3·n·d + p5·n²)·√n.
Sign AnglePolynomial::compare(const DistortedPoint& y, const Dyadic& angle) const {
  const StandardArithmetic standard;
  const Dyadic n = y.a * y.a + y.b * y.b, d = y.c * y.c;
  const auto& p = coefficients_;
  const Dyadic even = (p[0] - angle) * d * d + p[2] * n * d + p[4] * n * n;
  const Dyadic odd = p[1] * d * d + p[3] * n * d + p[5] * n * n;
  return sign_with_root(even * y.c, odd, n);
}

}  // namespace fathom::lens
