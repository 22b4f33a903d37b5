#include "fathom/evaluation/distance_bounds.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "fathom/evaluation/bounds.h"
#include "fathom/evaluation/nearest_place.h"

namespace fathom::evaluation {
namespace {

using bounds::distance_error;

/// Numbers in [0, 1] whose sum is at most 1 + 2⁻⁵³; NaN becomes 0.
std::pair<double, double> made_weights(double v, double w) {
  if (!(v > 0)) v = 0;
  if (v > 1) v = 1;
  const double rest = 1 - v;
  if (!(w > 0)) w = 0;
  if (w > rest) w = rest;
  return {v, w};
}

}  // namespace

/// From above: the distance from a point of the triangle. Divided by their sum, if that is above 1,
/// the weights are those of such a point, and q is near it (validation/proofs, evaluation_place).
/// From below: the triangle lies wholly beyond a plane across g = p − q if its corners do; for any
/// g,
///   distance ≥ min over the corners X of g·(p − X)/|g|
/// (evaluation_plane).
DistanceBounds distance_bounds(const PlacedTriangles::Corners& corners, const Vector& p) {
  const auto [v0, w0] = nearest_place(corners, p);
  const auto [v, w] = made_weights(v0, w0);
  Vector q;
  for (std::size_t k = 0; k < 3; ++k)
    q[k] =
        corners[0][k] + v * (corners[1][k] - corners[0][k]) + w * (corners[2][k] - corners[0][k]);
  const Vector g = minus(p, q);
  const double distance = length(g);
  if (!(distance > distance_error)) return {0, distance + distance_error};
  double least = std::numeric_limits<double>::infinity();
  for (const Vector& corner : corners) least = std::min(least, dot(g, minus(p, corner)));
  return {least / distance - distance_error, distance + distance_error};
}

}  // namespace fathom::evaluation
