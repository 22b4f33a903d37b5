#include "fathom/lens/stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

/// 1 and the numbers, without leading zeroes.
std::vector<double> polynomial(std::initializer_list<double> numbers) {
  std::vector<double> coefficients{1};
  coefficients.insert(coefficients.end(), numbers);
  while (coefficients.back() == 0) coefficients.pop_back();
  return coefficients;
}

/// Of k0 … k5, p0, p1, s0 … s3: one stage where the other changes nothing.
StageNumbers<double> in_two_stages(const std::array<double, 14>& d) {
  const std::vector<double> radial = polynomial({d[0], d[1], d[2], d[3], d[4], d[5]});
  StageNumbers<double> stage{{1}, {1}, d[7], d[6], d[8], d[9], d[10], d[11]};
  (is_radial(stage) ? stage.numerator : stage.before) = radial;
  if (radial.size() == 1) stage.before.clear();
  return stage;
}

}  // namespace

StageNumbers<double> stage_of(const Lens& lens) {
  const StandardArithmetic standard;
  const auto& d = lens.distortion;
  switch (lens.model) {
    case LensModel::simple_pinhole:
    case LensModel::pinhole:
    case LensModel::simple_fisheye:
    case LensModel::fisheye:
      return {{1}, {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::simple_radial:
    case LensModel::radial:
    case LensModel::simple_radial_fisheye:
    case LensModel::radial_fisheye:
      return {polynomial({d[0], d[1]}), {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::opencv:
    case LensModel::full_opencv:
    case LensModel::opencv_14:
      return {polynomial({d[0], d[1], d[4]}),
              polynomial({d[5], d[6], d[7]}),
              d[2],
              d[3],
              d[8],
              d[9],
              d[10],
              d[11]};
    case LensModel::brown:
      return {polynomial({d[0], d[1], d[2], d[3]}), {1}, d[4], d[5], 0, 0, 0, 0};
    case LensModel::opencv_fisheye:
      return {polynomial({d[0], d[1], d[2], d[3]}), {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::thin_prism_fisheye:
      return {polynomial({d[0], d[1], d[4], d[5]}), {1}, d[2], d[3], d[6], 0, d[7], 0};
    case LensModel::omni:
      return {polynomial({d[1], d[2]}), {1}, d[3], d[4], 0, 0, 0, 0};
    case LensModel::rad_tan_thin_prism_fisheye:
      return in_two_stages(d);
    case LensModel::fov:
    case LensModel::simple_division:
    case LensModel::division:
    case LensModel::fisheye_stereographic:
    case LensModel::ftheta:
    case LensModel::equirectangular:
    case LensModel::cylindrical:
    case LensModel::fisheye_orthographic:
    case LensModel::fisheye_equisolid:
    case LensModel::ucm:
    case LensModel::eucm:
    case LensModel::double_sphere:
    case LensModel::table:
      break;
  }
  throw std::logic_error("the lens model has no stage");
}

bool is_radial(const StageNumbers<double>& n) {
  const StandardArithmetic standard;
  return n.p1 == 0 && n.p2 == 0 && n.s1 == 0 && n.s2 == 0 && n.s3 == 0 && n.s4 == 0;
}

bool is_identity(const StageNumbers<double>& n) {
  return n.numerator.size() == 1 && n.denominator.size() == 1 && !n.is_double() && is_radial(n);
}

using namespace bounds;

namespace {

/// An interval in binary64. After each operation the ends are moved outwards by more than they were
/// rounded; what is not a number at an end stays so, and no comparison holds for it.
struct Range {
  double low, high;

  Range() = default;
  Range(double x) : low(x), high(x) {}
  Range(double a, double b)
      : low(a - (std::abs(a) * interval_room + std::numeric_limits<double>::min())),
        high(b + (std::abs(b) * interval_room + std::numeric_limits<double>::min())) {}
};

Range operator+(const Range& a, const Range& b) {
  return {a.low + b.low, a.high + b.high};
}
Range operator-(const Range& a, const Range& b) {
  return {a.low - b.high, a.high - b.low};
}
Range operator*(const Range& a, const Range& b) {
  const auto [least, greatest] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {least, greatest};
}
/// Needs    b.low > 0.
Range operator/(const Range& a, const Range& b) {
  const auto [least, greatest] =
      std::minmax({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
  return {least, greatest};
}

double greatest_size(double a, double b) {
  return std::max(std::abs(a), std::abs(b));
}

/// The least eigenvalue of [[xx, o], [o, yy]] is (xx + yy)/2 − √(((xx − yy)/2)² + o²).
double least_growth(const StageJacobian<Range>& J) {
  const double trace = (J.xx + J.yy).low;
  const Range across = J.xx - J.yy, along = J.xy + J.yx;
  const double difference = greatest_size(across.low, across.high);
  const double other = greatest_size(along.low, along.high);
  const double size = std::hypot(difference, other) * up;
  const double growth = (trace - size) / 2;
  return growth > (std::abs(trace) + size) * 0x1p-40 ? growth / up : 0;
}

/// The terms of S where |x| ≤ X, |y| ≤ Y and D ≥ least_D, the greater component.
double greatest_terms(const StageNumbers<double>& n, double X, double Y, double least_D) {
  const StagePoint<double> terms = stage_magnitudes(n, X, Y, least_D);
  return up * std::max(terms.x, terms.y);
}

}  // namespace

// The error of stage_value(), in u of the terms: q errs by 2 of itself, so that the k-th term of N
// errs by 2k and by the 2k + 1 roundings of Horner's scheme at most; with n the degree, N errs by
// 4n + 1, D by the same of its own terms (stage_magnitudes() has them as a factor), the quotient by
// 8n + 3, its product with x by 8n + 4. The other terms have at most 8 roundings, and there are
// four sums: 8n + 12 in all. Second order: 8n + 16. Of two stages, the first errs by 4n + 4 of its
// terms. The second takes the error over in products of at most four of its components, and errs by
// 16 itself: 4·(4n + 4) + 16 in all.
StageBounds bounds_on_box(const StageNumbers<double>& stage, const std::array<Interval, 2>& box) {
  const StandardArithmetic standard;
  const auto numbers = stage.in([](double x) { return Range(x); });
  const Range x(box[0].lower, box[0].upper), y(box[1].lower, box[1].upper);
  // The same product as in stage_jacobian(), which divides by this D.
  const Range D = horner(numbers.denominator, x * x + y * y);
  if (!(D.low > 0 && D.high < std::numeric_limits<double>::infinity())) return {};
  const double X = greatest_size(x.low, x.high), Y = greatest_size(y.low, y.high);
  if (!(denominator_magnitude(stage, X, Y) <= D.low * most_growth)) return {};
  const double degree = static_cast<double>(
      std::max({stage.numerator.size(), stage.denominator.size(), stage.before.size()}) - 1);
  return {least_growth(stage_jacobian(numbers, x, y)), greatest_terms(stage, X, Y, D.low),
          (stage.is_double() ? 2 : 1) * (of_degree * degree + of_stage)};
}

// With p = (p2, p1), S(m) = L·m + q·p + 2(m·p)·m + q·(s1 + s2·q, s3 + s4·q).
double greatest_on_circle(const StageNumbers<double>& stage, double q) {
  const StandardArithmetic standard;
  if (stage.is_double()) {
    const Range image = image_of_circle(stage.in([](double x) { return Range(x); }), Range(q));
    return greatest_on_circle(second_stage(stage), image.high);
  }
  const auto numbers = stage.in([](double x) { return Range(x); });
  const Range N = horner(numbers.numerator, Range(q)), D = horner(numbers.denominator, Range(q));
  if (!(D.low > 0)) return std::numeric_limits<double>::infinity();
  const Range L = N / D;
  const double prism = std::hypot(std::abs(stage.s1) + std::abs(stage.s2) * q,
                                  std::abs(stage.s3) + std::abs(stage.s4) * q);
  return up * (std::sqrt(q) * greatest_size(L.low, L.high) +
               q * (3 * std::hypot(stage.p1, stage.p2) + prism));
}

}  // namespace fathom::lens
