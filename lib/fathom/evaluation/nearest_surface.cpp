#include "fathom/evaluation/nearest_surface.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/evaluation/box_tree.h"
#include "fathom/numeric/certified.h"

namespace fathom::evaluation {
namespace {

using bounds::distance_error;

/// Approximate nearest point of a triangle, as A + v·(B − A) + w·(C − A). Has no error bound: the
/// functions that use it are correct for any v and w, and tight for good values.
/// Source   [Eri05] 5.1.5
std::pair<double, double> nearest_place(const PlacedTriangles::Corners& corners, const Vector& p) {
  const auto& [a, b, c] = corners;
  const Vector ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const Vector bp = minus(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const Vector cp = minus(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  const double sum = va + vb + vc;
  return {vb / sum, vc / sum};
}

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

/// From above: the distance from a point of the triangle. Divided by their sum, if it is above 1,
/// the weights define a point of the triangle, and q is near it (validation/proofs,
/// evaluation_place). From below: the triangle lies wholly beyond a plane across g = p − q if its
/// corners do; for any g,
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

/// Needs a point and a point of a cloud within bounds::point_error and bounds::corner_error of the
/// exact ones: a box without extent (validation/proofs, evaluation_gap).
DistanceBounds distance_bounds(const Vector& p, const Vector& q) {
  const double distance = length(minus(p, q));
  return {distance - distance_error, distance + distance_error};
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

Dyadic squared_distance(const WorldPoint& p, const WorldPoint& q) {
  return square(between(p, q));
}

namespace {

/// Not more than the distance of the exact point from the exact triangles in the box: each gap errs
/// by at most bounds::difference_error (validation/proofs, evaluation_gap).
double least_distance(const Box& box, const Vector& p) {
  Vector gap;
  for (std::size_t k = 0; k < 3; ++k)
    gap[k] = std::max({box.lower[k] - p[k], p[k] - box.upper[k], 0.0});
  return length(gap) - bounds::distance_error;
}

struct Candidate {
  std::uint32_t number;
  double lower;
};

/// Triangles or points that may be the nearest.
struct Candidates {
  std::vector<Candidate> list;
  /// The surface is not farther away.
  double upper = std::numeric_limits<double>::infinity();

  void add(std::uint32_t number, const DistanceBounds& bounds) {
    if (bounds.lower > upper) return;
    upper = std::min(upper, bounds.upper);
    list.push_back({number, bounds.lower});
  }
};

/// A node that is still to be looked at.
struct Waiting {
  std::uint32_t node;
  double lower;
};

/// `bounds_of` an element of the tree: of its distance from p.
template <class BoundsOf>
Candidates candidates_for(const Vector& p, const BoxTree& tree, const BoundsOf& bounds_of) {
  const std::vector<BoxTree::Node>& nodes = tree.nodes();
  Candidates candidates;
  std::vector<Waiting> waiting{{0, 0}};
  while (!waiting.empty()) {
    const auto [number, lower] = waiting.back();
    waiting.pop_back();
    if (lower > candidates.upper) continue;
    const BoxTree::Node& node = nodes[number];
    if (node.count != 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t element = tree.order()[i];
        candidates.add(element, bounds_of(element));
      }
      continue;
    }
    Waiting near{number + 1, least_distance(nodes[number + 1].box, p)};
    Waiting far{node.first, least_distance(nodes[node.first].box, p)};
    if (far.lower < near.lower) std::swap(near, far);
    waiting.push_back(far);
    waiting.push_back(near);
  }
  return candidates;
}

/// The least of the exact ones among the candidates, which are not empty.
template <class SquaredDistanceOf>
auto least_of(const Candidates& candidates, const SquaredDistanceOf& squared_distance_of) {
  decltype(squared_distance_of(0)) least;
  bool found = false;
  for (const Candidate& candidate : candidates.list) {
    if (candidate.lower > candidates.upper) continue;
    auto squared = squared_distance_of(candidate.number);
    if (!found || squared < least) least = std::move(squared);
    found = true;
  }
  return least;
}

}  // namespace

Ratio NearestSurface::squared_distance(const PlacedPoint& p) const {
  const Candidates candidates = candidates_for(p.near, tree_, [&](std::uint32_t triangle) {
    return distance_bounds(triangles_[triangle], p.near);
  });
  return least_of(candidates, [&](std::uint32_t triangle) {
    return evaluation::squared_distance(p.exact, source_.world_corners(triangle));
  });
}

Ratio NearestPoint::squared_distance(const PlacedPoint& p) const {
  const Candidates candidates = candidates_for(
      p.near, tree_, [&](std::uint32_t point) { return distance_bounds(p.near, cloud_[point]); });
  return least_of(candidates, [&](std::uint32_t point) {
    return evaluation::squared_distance(p.exact, cloud_.world(point));
  });
}

}  // namespace fathom::evaluation
