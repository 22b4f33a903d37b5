#include "fathom/reference/ray_decisions.h"

#include <limits>

namespace fathom::reference {
using triangle::ProjectedTriangle;
using triangle::Sample;

namespace {

/// a·of_a − b·of_b. area/ and triangle/ have the same text; this one is the reference's own, as it
/// decides ranges and the nearer of two surfaces for itself.
LinearForm minus(const LinearForm& a, const Dyadic& of_a, const LinearForm& b, const Dyadic& of_b) {
  ExactVector3 l;
  for (std::size_t k = 0; k < 3; ++k) {
    l[k] = of_a * a.coefficients()[k] - of_b * b.coefficients()[k];
  }
  return LinearForm(l);
}

constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace

DistanceRange::DistanceRange(const ProjectedTriangle& t, const Camera& camera) {
  const QuadraticForm squared = (t.volume * t.volume) * squared_length();
  const auto less = [&](double limit) {
    QuadraticForm form = squared;
    form -= (Dyadic(limit) * limit) * square_of(t.weight.coefficients());
    return form;
  };
  if (camera.near > 0) above_near_ = less(camera.near);
  if (camera.far < no_limit) above_far_ = less(camera.far);
}

bool DistanceRange::contains(const Sample& s, TierCounts& counts) const {
  if (!above_near_ && !above_far_) return true;
  ++counts.exact;
  if (above_near_ && s.direction()->sign_of(*above_near_) == Sign::negative) return false;
  return !above_far_ || s.direction()->sign_of(*above_far_) != Sign::positive;
}

DepthRange::DepthRange(const ProjectedTriangle& t, const Camera& camera)
    : depth_(t.depth_numerator) {
  if (counts_distance(camera.projection)) {
    distance_.emplace(t, camera);
    return;
  }
  if (camera.near > 0) above_near_ = minus(t.depth_numerator, 1.0, t.weight, camera.near);
  if (camera.far < no_limit) above_far_ = minus(t.depth_numerator, 1.0, t.weight, camera.far);
}

bool DepthRange::contains(const Sample& s, TierCounts& counts) const {
  if (distance_) return distance_->contains(s, counts);
  if (s.sign_of(depth_, counts) != Sign::positive) return false;
  if (above_near_ && s.sign_of(*above_near_, counts) == Sign::negative) return false;
  return !above_far_ || s.sign_of(*above_far_, counts) != Sign::positive;
}

// |T_a|/w_a < |T_b|/w_b
Sign order_along(const ProjectedTriangle& a, const ProjectedTriangle& b,
                 const lens::ExactDirection& d) {
  return d.sign_of(minus(a.weight, b.volume, b.weight, a.volume).coefficients());
}

}  // namespace fathom::reference
