#include "fathom/triangle/ray_referee.h"

#include <limits>

#include "fathom/numeric/quadratic_form.h"

namespace fathom::triangle {
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
