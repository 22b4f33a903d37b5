#include "fathom/triangle/referee.h"

#include <algorithm>
#include <limits>

#include "fathom/numeric/exact_polynomial.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {
namespace {

/// Whether D of both is the same function on the image: n_a·w_b = n_b·w_a as polynomials. One of n
/// and w is constant, the same one for both (|Δ|: w for an orthographic, n for a perspective
/// camera), so three products of coefficients are compared.
bool in_one_plane(const ProjectedTriangle& a, const ProjectedTriangle& b, bool perspective) {
  const auto varying = [&](const ProjectedTriangle& t) -> const ExactVector3& {
    return (perspective ? t.weight : t.depth_numerator).coefficients();
  };
  const auto constant = [&](const ProjectedTriangle& t) -> const Dyadic& {
    return (perspective ? t.depth_numerator : t.weight).coefficients()[2];
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (compare(varying(a)[k] * constant(b), varying(b)[k] * constant(a)) != 0) return false;
  }
  return true;
}

}  // namespace

const ProjectedTriangle& Referee::projected(std::uint32_t number) {
  remembered_.make_room();
  return remembered_.get(number);
}

// The sign of Δ was certain when the triangle was binned, so double-words need not decide it.
bool Referee::covers(std::uint32_t number, const ImagePoint& s, RenderStatistics& statistics) {
  ++statistics.edges.exact;
  if (wide_) {
    if (const auto certain = wide_->covers(number, s)) {
      ++statistics.double_words;
      return *certain;
    }
  }
  TierCounts within;
  return triangle::covers(projected(number), s, within);
}

std::optional<bool> Referee::is_in_range_by_double_words(std::uint32_t number,
                                                         const ImagePoint& s) {
  const auto from_zero = wide_->compare_depth(number, s, 0);
  if (from_zero && *from_zero < 0) return false;
  const auto from_near =
      camera_.near > 0 ? wide_->compare_depth(number, s, camera_.near) : from_zero;
  if (from_near && *from_near < 0) return false;
  const auto from_far = camera_.far < std::numeric_limits<double>::infinity()
                            ? wide_->compare_depth(number, s, camera_.far)
                            : std::optional(-1);
  if (from_far && *from_far > 0) return false;
  if (from_zero && from_near && from_far) return true;
  return std::nullopt;
}

bool Referee::is_in_range(std::uint32_t number, const ImagePoint& s, RenderStatistics& statistics) {
  ++statistics.range.exact;
  if (wide_) {
    if (const auto certain = is_in_range_by_double_words(number, s)) {
      ++statistics.double_words;
      return *certain;
    }
  }
  return triangle::is_in_range(depth_at(projected(number), s), camera_);
}

/// Needs    triangles that are not degenerate.
bool Referee::lie_in_one_plane(std::uint32_t a, std::uint32_t b) {
  if (wide_ && wide_->lie_in_one_plane(a, b)) return true;
  remembered_.make_room();
  const ProjectedTriangle& ta = remembered_.get(a);
  return in_one_plane(ta, remembered_.get(b), is_perspective(camera_.projection));
}

bool Referee::hides(std::uint32_t a, std::uint32_t b, const ImagePoint& s,
                    RenderStatistics& statistics) {
  ++statistics.visibility.exact;
  const bool asked_before = first_ == std::min(a, b) && second_ == std::max(a, b);
  if (wide_ && !(asked_before && same_plane_)) {
    if (const auto order = wide_->compare_depths(a, b, s)) {
      ++statistics.double_words;
      return *order < 0;
    }
  }
  if (!asked_before) {
    first_ = std::min(a, b);
    second_ = std::max(a, b);
    same_plane_ = lie_in_one_plane(a, b);
  }
  if (same_plane_) {
    ++statistics.same_plane;
    return a < b;
  }
  remembered_.make_room();
  const ProjectedTriangle& ta = remembered_.get(a);
  const int order = compare(depth_at(ta, s), depth_at(remembered_.get(b), s));
  return order < 0 || (order == 0 && a < b);
}

namespace {

/// a·of_a − b·of_b
LinearForm difference(const LinearForm& a, const Dyadic& of_a, const LinearForm& b,
                      const Dyadic& of_b) {
  ExactVector3 l;
  for (std::size_t k = 0; k < 3; ++k)
    l[k] = of_a * a.coefficients()[k] - of_b * b.coefficients()[k];
  return LinearForm(l);
}

/// near ≤ |T|·|d|/w ≤ far, by the signs of differences of squares.
bool is_distance_in_range(const ProjectedTriangle& t, const lens::ExactDirection& d,
                          const Camera& camera) {
  const QuadraticForm weight = square_of(t.weight.coefficients());
  const auto from = [&](double limit) {
    QuadraticForm form = (t.volume * t.volume) * squared_length();
    form -= (Dyadic(limit) * limit) * weight;
    return d.sign_of(form);
  };
  if (camera.near > 0 && from(camera.near) == Sign::negative) return false;
  return camera.far == std::numeric_limits<double>::infinity() ||
         from(camera.far) != Sign::positive;
}

}  // namespace

bool RayReferee::covers(std::uint32_t number, const lens::ExactDirection& d,
                        RenderStatistics& statistics) {
  ++statistics.edges.exact;
  TierCounts within;
  return triangle::covers(projected(number), Sample(d), within);
}

// D = n/w with w > 0 where the triangle covers the sample.
bool RayReferee::is_in_range(std::uint32_t number, const lens::ExactDirection& d,
                             RenderStatistics& statistics) {
  ++statistics.range.exact;
  const ProjectedTriangle& t = projected(number);
  if (counts_distance(camera_.projection)) return is_distance_in_range(t, d, camera_);
  const Sample s(d);
  TierCounts within;
  if (s.sign_of(t.depth_numerator, within) != Sign::positive) return false;
  const auto from = [&](double limit) {
    return s.sign_of(difference(t.depth_numerator, 1.0, t.weight, limit), within);
  };
  if (camera_.near > 0 && from(camera_.near) == Sign::negative) return false;
  return camera_.far == std::numeric_limits<double>::infinity() ||
         from(camera_.far) != Sign::positive;
}

// |T_a|/w_a < |T_b|/w_b
bool RayReferee::hides(std::uint32_t a, std::uint32_t b, const lens::ExactDirection& d,
                       RenderStatistics& statistics) {
  ++statistics.visibility.exact;
  remembered_.make_room();
  const ProjectedTriangle &ta = remembered_.get(a), &tb = remembered_.get(b);
  const LinearForm nearer = difference(ta.weight, tb.volume, tb.weight, ta.volume);
  if (nearer.is_zero()) {
    ++statistics.same_plane;
    return a < b;
  }
  TierCounts within;
  const Sign sign = Sample(d).sign_of(nearer, within);
  return sign == Sign::positive || (sign == Sign::zero && a < b);
}

}  // namespace fathom::triangle
