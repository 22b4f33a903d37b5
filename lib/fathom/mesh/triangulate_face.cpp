#include "fathom/mesh/triangulate_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom {
namespace {

using Point2 = std::array<double, 2>;
using Corner = std::uint32_t;

std::array<double, 3> coordinates(const MeshPoint& p) {
  return {p.x, p.y, p.z};
}

/// The component of twice the Newell normal along `axis`, with (i, j, axis) cyclic:
/// Σ (a_i·b_j − a_j·b_i) over the edges ab.
Dyadic newell_component(std::span<const MeshPoint> ring, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Dyadic sum;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto a = coordinates(ring[k]);
    const auto b = coordinates(ring[k + 1 == ring.size() ? 0 : k + 1]);
    sum += Dyadic(a[i]) * Dyadic(b[j]);
    sum -= Dyadic(a[j]) * Dyadic(b[i]);
  }
  return sum;
}

int exact_projection_axis(std::span<const MeshPoint> ring) {
  int best = -1;
  Dyadic greatest;
  for (int axis = 0; axis < 3; ++axis) {
    Dyadic size = abs(newell_component(ring, axis));
    if (size > greatest) {
      greatest = std::move(size);
      best = axis;
    }
  }
  return best;
}

/// The same in binary64, or −2 where the errors do not let it be told.
///
/// Bound. With a, b relative to the first corner, each difference is rounded once, so each of the
/// 2(n−1) products carries a relative error of at most (1+u)³ − 1 < 3.01u, u = 2⁻⁵³, and the sum of
/// m = 2n terms one of at most (m−1)u more, relative to S = Σ |products| (as computed, which is
/// less than S(1 + (m+3)u)). Hence |error| ≤ (2n + 4)·u·S for n < 2²⁰. An underflowing product adds
/// at most 2⁻¹⁰⁷⁵ each; S ≥ 2⁻⁹⁰⁰ makes that less than u·S·2⁻¹⁰⁰, covered by the 4. An overflow
/// makes S infinite and is left to the exact test.
int filtered_projection_axis(std::span<const MeshPoint> ring) {
  if (ring.size() >= (std::size_t{1} << 20)) return -2;
  std::array<double, 3> sum{}, size{};
  const auto origin = coordinates(ring[0]);
  std::array<double, 3> a{};
  for (std::size_t k = 1; k < ring.size(); ++k) {
    auto b = coordinates(ring[k]);
    for (int i = 0; i < 3; ++i) b[i] -= origin[i];
    for (int axis = 0; axis < 3; ++axis) {
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      const double left = a[i] * b[j], right = a[j] * b[i];
      sum[axis] += left - right;
      size[axis] += std::abs(left) + std::abs(right);
    }
    a = b;
  }
  const double u = unit_roundoff<double> * static_cast<double>(2 * ring.size() + 4);
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(sum[axis]) > std::abs(sum[best])) best = axis;
  if (!(size[best] >= 0x1p-900 && size[best] < std::numeric_limits<double>::infinity())) return -2;
  // The bounds below are themselves rounded: the factor 1 + 2⁻²⁰ outweighs that many times over.
  const double least = std::abs(sum[best]) - u * size[best] * (1 + 0x1p-20);
  if (!(least > 0)) return -2;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == best) continue;
    const double greatest = std::abs(sum[axis]) + u * size[axis] * (1 + 0x1p-20) + 0x1p-1000;
    if (!(greatest * (1 + 0x1p-50) < least * (1 - 0x1p-50))) return -2;
  }
  return best;
}

/// The ring in its plane of projection.
std::vector<Point2> project(std::span<const MeshPoint> ring, int axis) {
  std::vector<Point2> result;
  result.reserve(ring.size());
  for (const MeshPoint& p : ring) {
    const auto c = coordinates(p);
    result.push_back({c[(axis + 1) % 3], c[(axis + 2) % 3]});
  }
  return result;
}

/// Numbers of the corners that differ from the one before them; the ring as a curve is the same.
std::vector<Corner> without_repeats(const std::vector<Point2>& points) {
  std::vector<Corner> result;
  for (Corner i = 0; i < points.size(); ++i)
    if (points[i] != points[i == 0 ? points.size() - 1 : i - 1]) result.push_back(i);
  return result;
}

/// Which half of the directions from a to b is in: +1 for angles in [0, π), −1 for [π, 2π).
int half_of_direction(const Point2& a, const Point2& b) {
  if (a[1] != b[1]) return b[1] > a[1] ? 1 : -1;
  return b[0] > a[0] ? 1 : -1;
}

/// At a corner b with a, b, c on one line: whether the way turns back on itself.
bool turns_back(const Point2& a, const Point2& b, const Point2& c) {
  return half_of_direction(a, b) != half_of_direction(b, c);
}

/// Turns one way or straight, and winds once: each full turn passes between the two halves of the
/// directions twice.
bool is_convex(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  Sign way = Sign::zero;
  int changes_of_half = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Point2& a = points[ring[k == 0 ? n - 1 : k - 1]];
    const Point2& b = points[ring[k]];
    const Point2& c = points[ring[k + 1 == n ? 0 : k + 1]];
    const Sign turn = orientation(a, b, c);
    const bool changes = half_of_direction(a, b) != half_of_direction(b, c);
    if (turn == Sign::zero && changes) return false;  // turns back
    if (turn != Sign::zero && way == Sign::zero) way = turn;
    if (turn != Sign::zero && turn != way) return false;
    changes_of_half += changes ? 1 : 0;
  }
  return way != Sign::zero && changes_of_half == 2;
}

bool lies_between(const Point2& p, const Point2& a, const Point2& b) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p[0], a[0], b[0]) && within(p[1], a[1], b[1]);
}

/// Whether the closed segments ab and cd have a point in common.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const Sign c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  const Sign a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (c_side * d_side == Sign::negative && a_side * b_side == Sign::negative) return true;
  return (c_side == Sign::zero && lies_between(c, a, b)) ||
         (d_side == Sign::zero && lies_between(d, a, b)) ||
         (a_side == Sign::zero && lies_between(a, c, d)) ||
         (b_side == Sign::zero && lies_between(b, c, d));
}

/// Whether the ring, in which neighbours differ, is a simple closed curve: neighbouring edges share
/// their corner only, others nothing. Edges are swept by their least abscissa.
bool is_simple(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  struct Edge {
    double least, greatest;
    std::size_t number;
  };
  const auto from = [&](std::size_t e) -> const Point2& { return points[ring[e]]; };
  const auto to = [&](std::size_t e) -> const Point2& {
    return points[ring[e + 1 == n ? 0 : e + 1]];
  };
  std::vector<Edge> edges(n);
  for (std::size_t e = 0; e < n; ++e) {
    const auto [least, greatest] = std::minmax(from(e)[0], to(e)[0]);
    edges[e] = {least, greatest, e};
    const std::size_t next = e + 1 == n ? 0 : e + 1;
    if (orientation(from(e), to(e), to(next)) == Sign::zero && turns_back(from(e), to(e), to(next)))
      return false;
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.least < b.least; });
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n && edges[k].least <= edges[i].greatest; ++k) {
      const std::size_t e = edges[i].number, f = edges[k].number;
      const std::size_t distance = e > f ? e - f : f - e;
      if (distance == 1 || distance == n - 1) continue;
      if (segments_meet(from(e), to(e), from(f), to(f))) return false;
    }
  }
  return true;
}

/// The way a simple ring runs: the turn at its lowest of the leftmost corners that is not straight.
Sign way_of(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (points[ring[k]] < points[ring[extreme]]) extreme = k;
  return orientation(points[ring[(extreme + n - 1) % n]], points[ring[extreme]],
                     points[ring[(extreme + 1) % n]]);
}

/// Cuts ears off a simple ring. A corner that is no ear remembers what makes it none, so that it is
/// looked at again only when that is gone or one of its neighbours is.
class EarClipping {
 public:
  EarClipping(const std::vector<Point2>& points, Sign way)
      : points_(points),
        way_(way),
        next_(points.size()),
        previous_(points.size()),
        obstacle_(points.size(), unknown) {
    const auto n = static_cast<Corner>(points.size());
    for (Corner i = 0; i < n; ++i) {
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[i] = i == 0 ? n - 1 : i - 1;
    }
  }

  Triangulation run(std::vector<std::array<Corner, 3>>& triangles) {
    std::size_t left = points_.size();
    while (left > 3) {
      const Corner ear = first_ear(left);
      if (ear == none) break;
      triangles.push_back({previous_[ear], ear, next_[ear]});
      cut(ear);
      --left;
    }
    // What is left: one last triangle, or, where there is no ear, a fan of it.
    const bool done = left == 3 && turn_at(next_[first_]) == way_;
    Corner a = next_[first_];
    for (std::size_t k = 2; k < left; ++k, a = next_[a]) triangles.push_back({first_, a, next_[a]});
    return done ? Triangulation::ear_clipping : Triangulation::fallback_fan;
  }

 private:
  static constexpr Corner unknown = 0xFFFFFFFF;
  /// It does not turn the ring's way: no other corner has to do with it.
  static constexpr Corner its_turn = 0xFFFFFFFE;
  static constexpr Corner removed = 0xFFFFFFFD;
  static constexpr Corner none = 0xFFFFFFFF;

  [[nodiscard]] Sign turn_at(Corner i) const {
    return orientation(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  Corner first_ear(std::size_t left) {
    Corner i = first_;
    for (std::size_t k = 0; k < left; ++k, i = next_[i]) {
      const bool settled = obstacle_[i] == its_turn ||
                           (obstacle_[i] != unknown && obstacle_[obstacle_[i]] != removed);
      if (!settled && is_ear(i)) return i;
    }
    return none;
  }

  bool is_ear(Corner i) {
    if (turn_at(i) != way_) {
      obstacle_[i] = its_turn;
      return false;
    }
    const Corner before = previous_[i], behind = next_[i];
    for (Corner k = next_[behind]; k != before; k = next_[k]) {
      if (!lies_in_triangle(points_[k], points_[before], points_[i], points_[behind])) continue;
      obstacle_[i] = k;
      return false;
    }
    return true;
  }

  /// Whether p lies in the closed triangle abc, which turns the ring's way, and is none of a, b, c.
  [[nodiscard]] bool lies_in_triangle(const Point2& p, const Point2& a, const Point2& b,
                                      const Point2& c) const {
    for (int axis = 0; axis < 2; ++axis) {
      const auto [least, greatest] = std::minmax({a[axis], b[axis], c[axis]});
      if (p[axis] < least || p[axis] > greatest) return false;
    }
    if (p == a || p == b || p == c) return false;
    return orientation(a, b, p) != -way_ && orientation(b, c, p) != -way_ &&
           orientation(c, a, p) != -way_;
  }

  void cut(Corner ear) {
    const Corner before = previous_[ear], behind = next_[ear];
    next_[before] = behind;
    previous_[behind] = before;
    obstacle_[ear] = removed;
    obstacle_[before] = obstacle_[behind] = unknown;
    if (first_ == ear) first_ = behind;
  }

  const std::vector<Point2>& points_;
  Sign way_;
  std::vector<Corner> next_, previous_;
  /// Per corner what keeps it from being an ear: another corner, or one of the values above.
  std::vector<Corner> obstacle_;
  Corner first_ = 0;
};

Triangulation fan(std::size_t n, Triangulation kind,
                  std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (Corner k = 1; k + 1 < n; ++k) triangles.push_back({0, k, k + 1});
  return kind;
}

}  // namespace

int projection_axis(std::span<const MeshPoint> ring) {
  const int axis = filtered_projection_axis(ring);
  return axis == -2 ? exact_projection_axis(ring) : axis;
}

Triangulation triangulate_face(std::span<const MeshPoint> ring,
                               std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (ring.size() == 3) return fan(3, Triangulation::convex_fan, triangles);
  const int axis = projection_axis(ring);
  if (axis < 0) return fan(ring.size(), Triangulation::fallback_fan, triangles);
  const std::vector<Point2> points = project(ring, axis);
  const std::vector<Corner> curve = without_repeats(points);
  if (is_convex(points, curve)) return fan(ring.size(), Triangulation::convex_fan, triangles);
  if (!is_simple(points, curve)) return fan(ring.size(), Triangulation::fallback_fan, triangles);
  return EarClipping(points, way_of(points, curve)).run(triangles);
}

}  // namespace fathom
