#include "fathom/evaluation/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/evaluation/exact_distance.h"

// Bounds on distances. Every coordinate is below 1 (power_of_unit), a corner errs by at most 2⁻⁵⁴ in
// each (PlacedTriangles::error), the point by at most 2⁻⁴⁹ (PlacedPoint::error), and no distance is
// above 2√3 < 4. So a difference of two coordinates is below 2 and errs by at most 2⁻⁵² of its own
// rounding and 2⁻⁴⁹ + 2⁻⁵⁴, in all less than 2⁻⁴⁸; what underflows is less than 2⁻¹⁰⁰⁰.
namespace fathom::evaluation {
namespace {

/// More than any bound below loses.
constexpr double slack = 0x1p-46;
static_assert(PlacedTriangles::error <= 0x1p-54 && PlacedPoint::error <= 0x1p-49);

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}

/// Not more than the distance from any point of the box, in which the exact triangles lie within
/// 2⁻⁵⁴. Each gap errs by less than 2⁻⁴⁸, their root by less than √3 times that and 2⁻⁵⁰ by rounding.
double least_distance(const Box& box, const Vector& p) {
  Vector gap;
  for (std::size_t k = 0; k < 3; ++k)
    gap[k] = std::max({box.lower[k] - p[k], p[k] - box.upper[k], 0.0});
  return length(gap) - slack;
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

/// About the place of the nearest point of a triangle, as A + v·(B − A) + w·(C − A). The bounds hold
/// for any v and w; good ones make them tight.
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

struct Bounds {
  double lower, upper;
};

/// From above: the distance from a point of the triangle, which the made weights, divided by their
/// sum if that is above 1, have within 2⁻⁴⁹ in each coordinate of q; with the error of p and that of
/// the root less than slack.
/// From below: the triangle lies wholly beyond a plane across g = p − q if its corners do; for any g,
///   distance ≥ min over the corners X of g·(p − X)/|g|.
/// Each component of p − X errs by less than 2⁻⁴⁸, which g/|g| makes less than √3·2⁻⁴⁸; the products,
/// sums and quotient, below 4, lose less than 2⁻⁴⁹ where |g| > slack and nothing underflows.
Bounds bounds_of_distance(const PlacedTriangles::Corners& corners, const Vector& p) {
  const auto [v0, w0] = nearest_place(corners, p);
  const auto [v, w] = made_weights(v0, w0);
  Vector q;
  for (std::size_t k = 0; k < 3; ++k)
    q[k] =
        corners[0][k] + v * (corners[1][k] - corners[0][k]) + w * (corners[2][k] - corners[0][k]);
  const Vector g = minus(p, q);
  const double distance = length(g);
  if (!(distance > slack)) return {0, distance + slack};
  double least = std::numeric_limits<double>::infinity();
  for (const Vector& corner : corners) least = std::min(least, dot(g, minus(p, corner)));
  return {least / distance - slack, distance + slack};
}

struct Candidate {
  std::uint32_t number;
  double lower;
};

/// Triangles that may be the nearest.
struct Candidates {
  std::vector<Candidate> list;
  /// The surface is not farther away.
  double upper = std::numeric_limits<double>::infinity();

  void add(std::uint32_t number, const Bounds& bounds) {
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

Candidates candidates_for(const Vector& p, const PlacedTriangles& triangles,
                          const TriangleTree& tree) {
  const std::vector<TriangleTree::Node>& nodes = tree.nodes();
  Candidates candidates;
  std::vector<Waiting> waiting{{0, 0}};
  while (!waiting.empty()) {
    const auto [number, lower] = waiting.back();
    waiting.pop_back();
    if (lower > candidates.upper) continue;
    const TriangleTree::Node& node = nodes[number];
    if (node.count != 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t triangle = tree.order()[i];
        candidates.add(triangle, bounds_of_distance(triangles[triangle], p));
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

}  // namespace

Ratio NearestSurface::squared_distance(const PlacedPoint& p) const {
  const Candidates candidates = candidates_for(p.near, triangles_, tree_);
  Ratio least;
  bool found = false;
  for (const Candidate& candidate : candidates.list) {
    if (candidate.lower > candidates.upper) continue;
    Ratio squared = evaluation::squared_distance(p.exact, source_.world_corners(candidate.number));
    if (!found || squared < least) least = std::move(squared);
    found = true;
  }
  return least;
}

}  // namespace fathom::evaluation
