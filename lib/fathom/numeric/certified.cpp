#include "fathom/numeric/certified.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/determinant.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace fathom {
namespace {

/// CGAL's interval type, for use while a Rounding object lives: the processor then rounds upwards.
using FilterNumber = CGAL::Interval_nt<false>;
using Rounding = FilterNumber::Protector;

FilterNumber filter_number(const Interval& x) {
  return {x.lower, x.upper};
}

bool is_below(const Interval& x, double bound) {
  return std::abs(x.lower) < bound && std::abs(x.upper) < bound;
}

// The filters are used only where nothing can overflow, so that ∞ − ∞ and 0·∞ never arise:
// a determinant of entries below 2³⁰⁰ has products below 2⁹⁰⁰ and six terms; a linear form has
// coefficients below 2⁹⁰⁰ and is evaluated at |u|, |v| < 2¹⁰⁰.
constexpr double greatest_determinant_entry = 0x1p300;
constexpr double greatest_coefficient = 0x1p900;
constexpr double greatest_sample_coordinate = 0x1p100;

/// The sign that an interval certifies; a NaN certifies nothing.
std::optional<Sign> certified_sign(const FilterNumber& x) {
  if (x.inf() > 0) return Sign::positive;
  if (x.sup() < 0) return Sign::negative;
  if (x.inf() == 0 && x.sup() == 0) return Sign::zero;
  return std::nullopt;
}

bool may_filter(bool filterable, double u, double v) {
  return filterable && std::abs(u) < greatest_sample_coordinate &&
         std::abs(v) < greatest_sample_coordinate;
}

FilterNumber filter_value(const std::array<Interval, 3>& l, double u, double v) {
  return filter_number(l[0]) * FilterNumber(u) + filter_number(l[1]) * FilterNumber(v) +
         filter_number(l[2]);
}

}  // namespace

ExactVector3 without_common_factor(ExactVector3 v) {
  divide_by_common_factor(v);
  return v;
}

ExactVector3 cross(const ExactVector3& a, const ExactVector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Dyadic dot(const ExactVector3& a, const ExactVector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<ExactVector3, 3> cofactors(const std::array<ExactVector3, 3>& rows) {
  return {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
}

Dyadic determinant(const ExactVector3& a, const ExactVector3& b, const ExactVector3& c) {
  return dot(a, cross(b, c));
}

Sign sign_of_determinant(const ExactVector3& a, const ExactVector3& b, const ExactVector3& c,
                         TierCounts& counts) {
  std::array<Interval, 9> e;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = enclose(a[i]);
    e[3 + i] = enclose(b[i]);
    e[6 + i] = enclose(c[i]);
  }
  const bool filterable = std::all_of(e.begin(), e.end(), [](const Interval& x) {
    return is_below(x, greatest_determinant_entry);
  });
  std::optional<Sign> sign;
  if (filterable) {
    const Rounding upwards;
    const auto n = [&](std::size_t i) { return filter_number(e[i]); };
    sign = certified_sign(CGAL::determinant(n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8)));
  }
  if (sign) {
    ++counts.interval;
    return *sign;
  }
  ++counts.exact;
  return determinant(a, b, c).sign();
}

Sign orientation(const std::array<double, 2>& a, const std::array<double, 2>& b,
                 const std::array<double, 2>& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const std::array<double, 2>& p) { return Kernel::Point_2(p[0], p[1]); };
  return sign_of(CGAL::orientation(point(a), point(b), point(c)));
}

bool is_simple_ring(const std::vector<std::array<double, 2>>& corners) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(corners.size());
  for (const auto& [x, y] : corners) points.emplace_back(x, y);
  return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

LinearForm::LinearForm(ExactVector3 coefficients) : coefficients_(std::move(coefficients)) {
  for (std::size_t i = 0; i < 3; ++i) enclosures_[i] = enclose(coefficients_[i]);
  filterable_ = std::all_of(enclosures_.begin(), enclosures_.end(),
                            [](const Interval& x) { return is_below(x, greatest_coefficient); });
}

bool LinearForm::is_zero() const {
  return coefficients_[0].is_zero() && coefficients_[1].is_zero() && coefficients_[2].is_zero();
}

LinearForm LinearForm::operator-() const {
  return LinearForm({-coefficients_[0], -coefficients_[1], -coefficients_[2]});
}

Dyadic LinearForm::at(double u, double v) const {
  return coefficients_[0] * Dyadic(u) + coefficients_[1] * Dyadic(v) + coefficients_[2];
}

Interval LinearForm::enclose_at(double u, double v) const {
  if (!may_filter(filterable_, u, v)) return enclose(at(u, v));
  const Rounding upwards;
  const FilterNumber value = filter_value(enclosures_, u, v);
  return {value.inf(), value.sup()};
}

Interval LinearForm::enclose_at(const std::array<Interval, 3>& box) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool is_near = std::all_of(box.begin(), box.end(), [](const Interval& x) {
    return is_below(x, greatest_sample_coordinate);
  });
  if (!filterable_ || !is_near) return {-infinity, infinity};
  const Rounding upwards;
  FilterNumber value = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    value += filter_number(enclosures_[k]) * filter_number(box[k]);
  }
  return {value.inf(), value.sup()};
}

Sign LinearForm::sign_at(double u, double v, TierCounts& counts) const {
  std::optional<Sign> sign;
  if (may_filter(filterable_, u, v)) {
    const Rounding upwards;
    sign = certified_sign(filter_value(enclosures_, u, v));
  }
  if (sign) {
    ++counts.interval;
    return *sign;
  }
  ++counts.exact;
  return at(u, v).sign();
}

Interval quotient(const Interval& a, const Interval& b) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool finite = is_below(a, infinity) && is_below(b, infinity);
  if (!finite || (b.lower <= 0 && b.upper >= 0)) return {-infinity, infinity};
  const Rounding upwards;
  const FilterNumber q = filter_number(a) / filter_number(b);
  return {q.inf(), q.sup()};
}

}  // namespace fathom
