#include "fathom/mesh/planar_ring.h"

#include <algorithm>
#include <cstddef>

namespace fathom::mesh {
namespace {

/// Up to so many corners, edges are compared pair by pair: nothing is allocated for it.
constexpr std::size_t few_corners = 64;

/// Which half of the directions from a to b is in: +1 for angles in [0, π), −1 for [π, 2π).
int half_of_direction(const Point2& a, const Point2& b) {
  if (a[1] != b[1]) return b[1] > a[1] ? 1 : -1;
  return b[0] > a[0] ? 1 : -1;
}

/// At a corner b with a, b, c on one line: whether the ring turns back on itself.
bool turns_back(const Point2& a, const Point2& b, const Point2& c) {
  return half_of_direction(a, b) != half_of_direction(b, c);
}

bool lies_between(const Point2& p, const Point2& a, const Point2& b) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p[0], a[0], b[0]) && within(p[1], a[1], b[1]);
}

/// Whether the closed segments ab and cd have a point in common.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  for (int axis = 0; axis < 2; ++axis) {
    if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis])) return false;
    if (std::max(c[axis], d[axis]) < std::min(a[axis], b[axis])) return false;
  }
  const Sign c_side = turn_of(a, b, c), d_side = turn_of(a, b, d);
  const Sign a_side = turn_of(c, d, a), b_side = turn_of(c, d, b);
  if (c_side * d_side == Sign::negative && a_side * b_side == Sign::negative) return true;
  return (c_side == Sign::zero && lies_between(c, a, b)) ||
         (d_side == Sign::zero && lies_between(d, a, b)) ||
         (a_side == Sign::zero && lies_between(a, c, d)) ||
         (b_side == Sign::zero && lies_between(b, c, d));
}

/// Whether no two edges but neighbours meet, by comparing each two.
bool no_edges_meet(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  const auto corner = [&](std::size_t k) -> const Point2& { return points[ring[k == n ? 0 : k]]; };
  for (std::size_t e = 0; e < n; ++e) {
    for (std::size_t f = e + 2; f < n; ++f) {
      if (e == 0 && f == n - 1) continue;
      if (segments_meet(corner(e), corner(e + 1), corner(f), corner(f + 1))) return false;
    }
  }
  return true;
}

/// The same by a sweep over the plane.
bool no_edges_meet_in_sweep(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  std::vector<Point2> corners;
  corners.reserve(ring.size());
  for (const Corner i : ring) corners.push_back(points[i]);
  return is_simple_ring(corners);
}

}  // namespace

std::vector<Corner> without_repeats(const std::vector<Point2>& points) {
  std::vector<Corner> result;
  result.reserve(points.size());
  for (Corner i = 0; i < points.size(); ++i)
    if (points[i] != points[i == 0 ? points.size() - 1 : i - 1]) result.push_back(i);
  return result;
}

// It winds once: each full turn passes between the two halves of the directions twice.
bool is_convex(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  Sign way = Sign::zero;
  int changes_of_half = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Point2& a = points[ring[k == 0 ? n - 1 : k - 1]];
    const Point2& b = points[ring[k]];
    const Point2& c = points[ring[k + 1 == n ? 0 : k + 1]];
    const Sign turn = turn_of(a, b, c);
    const bool changes = half_of_direction(a, b) != half_of_direction(b, c);
    if (turn == Sign::zero && changes) return false;  // turns back
    if (turn != Sign::zero && way == Sign::zero) way = turn;
    if (turn != Sign::zero && turn != way) return false;
    changes_of_half += changes ? 1 : 0;
  }
  return way != Sign::zero && changes_of_half == 2;
}

bool is_simple(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  for (std::size_t k = 0; k < n; ++k) {
    const Point2& a = points[ring[k == 0 ? n - 1 : k - 1]];
    const Point2& b = points[ring[k]];
    const Point2& c = points[ring[k + 1 == n ? 0 : k + 1]];
    if (turn_of(a, b, c) == Sign::zero && turns_back(a, b, c)) return false;
  }
  return n <= few_corners ? no_edges_meet(points, ring) : no_edges_meet_in_sweep(points, ring);
}

// At the lowest of its leftmost corners, where it is not straight.
Sign way_of(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (points[ring[k]] < points[ring[extreme]]) extreme = k;
  return turn_of(points[ring[(extreme + n - 1) % n]], points[ring[extreme]],
                 points[ring[(extreme + 1) % n]]);
}

}  // namespace fathom::mesh
