#include "fathom/triangle/ray_values.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/triangle/settled_storage.h"

namespace fathom::triangle {
using lens::ExactDirection;

namespace {

/// The direction of a ray as intervals.
using Direction = std::array<DyadicInterval, 3>;

DyadicInterval value_of(const ExactVector3& form, const Direction& d) {
  DyadicInterval sum;
  for (std::size_t k = 0; k < 3; ++k) sum = sum + form[k] * d[k];
  return sum;
}

/// A sum of squares, as all quadratic forms here are.
DyadicInterval value_of(const QuadraticForm& form, const Direction& d) {
  DyadicInterval sum;
  for (std::size_t k = 0; k < 3; ++k) sum = sum + form.coefficients[k] * square(d[k]);
  sum = sum + form.coefficients[3] * (d[0] * d[1]);
  sum = sum + form.coefficients[4] * (d[0] * d[2]);
  sum = sum + form.coefficients[5] * (d[1] * d[2]);
  return {std::max(sum.low, Dyadic()), sum.high};
}

Dyadic value_of(const ExactVector3& form, const ExactVector3& d) {
  return dot(form, d);
}
Dyadic value_of(const QuadraticForm& form, const ExactVector3& d) {
  return form.at(d);
}

/// a − factor·b
ExactVector3 difference(ExactVector3 a, const Dyadic& factor, const ExactVector3& b) {
  for (std::size_t k = 0; k < 3; ++k) a[k] -= factor * b[k];
  return a;
}
QuadraticForm difference(QuadraticForm a, const Dyadic& factor, const QuadraticForm& b) {
  a -= factor * b;
  return a;
}

/// n / w at a ray, of two linear or two quadratic forms; w > 0 there.
template <class Form>
class QuotientAtRay {
 public:
  QuotientAtRay(const ExactDirection& d, Form n, Form w)
      : d_(d), n_(std::move(n)), w_(std::move(w)) {}

  [[nodiscard]] Enclosure enclose(long bits) const {
    for (;; bits *= 2) {
      const Direction d = d_.enclosure(bits);
      const DyadicInterval n = value_of(n_, d), w = value_of(w_, d);
      if (w.low.sign() != Sign::positive) continue;
      return {Ratio(n.low, n.low.sign() == Sign::negative ? w.low : w.high),
              Ratio(n.high, n.high.sign() == Sign::negative ? w.high : w.low)};
    }
  }

  /// The value where rounding, or rounding of its root, steps.
  [[nodiscard]] std::optional<Ratio> decide() const {
    if (d_.sign_of(n_) == Sign::zero) return Ratio();
    constexpr long first_bits = 192;
    for (long bits = first_bits;; bits *= 2) {
      const Enclosure e = enclose(bits);
      if (!is_narrow(e)) continue;
      const std::optional<Dyadic> candidate = shortest_within(e);
      if (!candidate) return std::nullopt;
      const bool is_equal = d_.sign_of(difference(n_, *candidate, w_)) == Sign::zero;
      return is_equal ? std::optional(Ratio(*candidate)) : std::nullopt;
    }
  }

 private:
  /// Whether both ends have one sign and differ by at most 2⁻¹²⁸ of them.
  static bool is_narrow(const Enclosure& e) {
    if (e.low.sign() != e.high.sign() || e.low.sign() == Sign::zero) return false;
    const Ratio width = e.high - e.low;
    const Ratio& nearer = e.low.sign() == Sign::positive ? e.low : e.high;
    const Ratio most(abs(nearer.numerator).scaled(-128), nearer.denominator);
    return !(most < width);
  }

  const ExactDirection& d_;
  Form n_, w_;
};

template <class Form>
Real quotient_of(const ExactDirection& d, const Form& numerator, const Form& denominator) {
  if (const ExactVector3* const rational = d.rational()) {
    return Ratio(value_of(numerator, *rational), value_of(denominator, *rational));
  }
  const auto quotient = std::make_shared<const QuotientAtRay<Form>>(d, numerator, denominator);
  return {[quotient](long bits) { return quotient->enclose(bits); },
          [quotient] { return quotient->decide(); }};
}

Certified<double> certified_in(const RayBox& box, const LinearForm& form) {
  return to_certified(form.enclose_at(box));
}

Certified<double> quotient_in(const RayBox& box, const LinearForm& numerator,
                              const LinearForm& denominator) {
  return quotient(certified_in(box, numerator), certified_in(box, denominator));
}

/// volume·|d| / weight(d)
Certified<double> length_in(const RayBox& box, const Dyadic& volume, const LinearForm& weight) {
  Certified<double> squared{0, 0};
  for (const Interval& component : box) {
    const Certified<double> x = to_certified(component);
    squared = sum(squared, product(x, x));
  }
  const Certified<double> along =
      quotient(to_certified(enclose(volume)), certified_in(box, weight));
  return product(along, sqrt(squared));
}

}  // namespace

std::array<LinearForm, 3> position_forms(const ProjectedTriangle& t) {
  const auto& [A, B, C] = t.world;
  return {interpolated_form(t, {A.x, B.x, C.x}), interpolated_form(t, {A.y, B.y, C.y}),
          interpolated_form(t, {A.z, B.z, C.z})};
}

Real quotient_at(const ExactDirection& d, const LinearForm& numerator,
                 const LinearForm& denominator) {
  return quotient_of(d, numerator.coefficients(), denominator.coefficients());
}

float binary32_at(const ExactDirection& d, const LinearForm& numerator,
                  const LinearForm& denominator) {
  if (const auto settled = binary32_in(d.box(), numerator, denominator)) return *settled;
  return round_to_binary32(quotient_at(d, numerator, denominator));
}

std::optional<float> binary32_in(const RayBox& box, const LinearForm& numerator,
                                 const LinearForm& denominator) {
  const Certified<double> value = quotient_in(box, numerator, denominator);
  return fathom::to_binary32(value.value, value.error);
}

std::optional<float> distance_in(const RayBox& box, const Dyadic& volume,
                                 const LinearForm& weight) {
  const Certified<double> value = length_in(box, volume, weight);
  return fathom::to_binary32(value.value, value.error);
}

Real quotient_at(const ExactDirection& d, const QuadraticForm& numerator,
                 const QuadraticForm& denominator) {
  return quotient_of(d, numerator, denominator);
}

RaySurface::RaySurface(const ProjectedTriangle& t, const Wanted& wanted)
    : wanted_(wanted), weight_(t.weight) {
  if (wanted.position) position_ = position_forms(t);
  if (wanted.barycentric) barycentric_ = {t.edges[1], t.edges[2]};
  if (wanted.distance) volume_ = t.volume;
  if (wanted.depth) depth_ = t.depth_numerator;
}

bool RaySurface::write(std::size_t pixel, const RayBox& box, const rendering::ChannelValues& values,
                       const CodeFactor& codes) const {
  const auto settle = [&](float* channel, const LinearForm& form) {
    const auto settled = binary32_in(box, form, weight_);
    if (settled) channel[pixel] = *settled;
    return settled.has_value();
  };
  if (wanted_.position) {
    for (std::size_t k = 0; k < 3; ++k)
      if (!settle(values.position[k], position_[k])) return false;
  }
  if (wanted_.barycentric) {
    for (std::size_t k = 0; k < 2; ++k)
      if (!settle(values.barycentric[k], barycentric_[k])) return false;
  }
  if (wanted_.depth && !store(values.depth, pixel, quotient_in(box, depth_, weight_), codes))
    return false;
  return !wanted_.distance ||
         store(values.distance, pixel, length_in(box, volume_, weight_), codes);
}

}  // namespace fathom::triangle
