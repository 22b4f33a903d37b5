#include "fathom/evaluation/exact_distance.h"

#include <utility>

#include "fathom/numeric/certified.h"

namespace fathom::evaluation {
namespace {

ExactVector3 between(const WorldPoint& from, const WorldPoint& to) {
  return {to.x - from.x, to.y - from.y, to.z - from.z};
}

Dyadic square(const ExactVector3& v) {
  return dot(v, v);
}

/// Whether the foot of the perpendicular from p is on the inside of the line from `from` to `to`,
/// of a triangle with this normal, which is not zero.
bool is_inside(const WorldPoint& from, const WorldPoint& to, const WorldPoint& p,
               const ExactVector3& normal) {
  return dot(cross(between(from, to), between(from, p)), normal).sign() != Sign::negative;
}

Ratio squared_distance_of_segment(const WorldPoint& p, const WorldPoint& a, const WorldPoint& b) {
  const ExactVector3 ab = between(a, b), ap = between(a, p);
  const Dyadic along = dot(ap, ab), length = square(ab);
  if (along.sign() != Sign::positive) return square(ap);
  if (along >= length) return square(between(b, p));
  return {square(cross(ap, ab)), length};
}

}  // namespace

Ratio squared_distance(const WorldPoint& p, const std::array<WorldPoint, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const ExactVector3 normal = cross(between(a, b), between(a, c));
  const Dyadic length = square(normal);
  if (!length.is_zero() && is_inside(a, b, p, normal) && is_inside(b, c, p, normal) &&
      is_inside(c, a, p, normal)) {
    const Dyadic height = dot(between(a, p), normal);
    return {height * height, length};
  }
  Ratio least = squared_distance_of_segment(p, a, b);
  for (const auto& [from, to] : {std::pair(&b, &c), std::pair(&c, &a)}) {
    Ratio other = squared_distance_of_segment(p, *from, *to);
    if (other < least) least = std::move(other);
  }
  return least;
}

}  // namespace fathom::evaluation
