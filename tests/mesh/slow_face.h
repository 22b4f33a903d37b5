#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "fathom/mesh/triangulate_face.h"
#include "fathom/numeric/certified.h"

/// Faces that are not convex, cut the slow way: a judge of faces too large for the oracle, which
/// shares nothing with what is tested but the sign of a turn.
namespace fathom::checks::slow {

using mesh::Triangulation;
using Point2 = std::array<double, 2>;
using Corner = std::uint32_t;

/// Numbers of the corners that differ from the one before them; they trace the same curve.
inline std::vector<Corner> without_repeats(const std::vector<Point2>& points) {
  std::vector<Corner> result;
  for (Corner i = 0; i < points.size(); ++i)
    if (points[i] != points[i == 0 ? points.size() - 1 : i - 1]) result.push_back(i);
  return result;
}

/// Which half of the directions from a to b is in: +1 for angles in [0, π), −1 for [π, 2π).
inline int half_of_direction(const Point2& a, const Point2& b) {
  if (a[1] != b[1]) return b[1] > a[1] ? 1 : -1;
  return b[0] > a[0] ? 1 : -1;
}

/// At a corner b with a, b, c on one line: whether the ring turns back on itself.
inline bool turns_back(const Point2& a, const Point2& b, const Point2& c) {
  return half_of_direction(a, b) != half_of_direction(b, c);
}

inline bool lies_between(const Point2& p, const Point2& a, const Point2& b) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p[0], a[0], b[0]) && within(p[1], a[1], b[1]);
}

/// Whether the closed segments ab and cd have a point in common.
inline bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const Sign c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  const Sign a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (c_side * d_side == Sign::negative && a_side * b_side == Sign::negative) return true;
  return (c_side == Sign::zero && lies_between(c, a, b)) ||
         (d_side == Sign::zero && lies_between(d, a, b)) ||
         (a_side == Sign::zero && lies_between(a, c, d)) ||
         (b_side == Sign::zero && lies_between(b, c, d));
}

/// Whether the ring, in which neighbours differ, is a simple closed curve: neighbouring edges share
/// only their corner, others nothing. Edges are swept by their least abscissa.
inline bool is_simple(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
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

/// The way a simple ring turns: at the lowest of its leftmost corners, where it is not straight.
inline Sign way_of(const std::vector<Point2>& points, const std::vector<Corner>& ring) {
  const std::size_t n = ring.size();
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (points[ring[k]] < points[ring[extreme]]) extreme = k;
  return orientation(points[ring[(extreme + n - 1) % n]], points[ring[extreme]],
                     points[ring[(extreme + 1) % n]]);
}

/// Cuts ears off a simple ring. A corner that is no ear remembers an obstacle, so that it is looked
/// at again only when that or one of its neighbours is gone.
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
  /// It does not turn the ring's way; that has nothing to do with any other corner.
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
  /// For each corner what keeps it from being an ear: another corner, or one of the values above.
  std::vector<Corner> obstacle_;
  Corner first_ = 0;
};

/// A face that lies in the plane of x and y, in which the ring is projected as it is, and is not
/// convex.
inline Triangulation triangulate(const std::vector<Point2>& points,
                                 std::vector<std::array<Corner, 3>>& triangles) {
  const std::vector<Corner> curve = without_repeats(points);
  if (is_simple(points, curve)) return EarClipping(points, way_of(points, curve)).run(triangles);
  for (Corner k = 1; k + 1 < points.size(); ++k) triangles.push_back({0, k, k + 1});
  return Triangulation::fallback_fan;
}

}  // namespace fathom::checks::slow
