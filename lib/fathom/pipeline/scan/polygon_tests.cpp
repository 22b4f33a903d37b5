#include "fathom/pipeline/scan/polygon_tests.h"

#include <algorithm>

#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

using clipping::sign_of;

/// Which half of the directions d is in: 0 for angles in [0, π), 1 for [π, 2π), with y up.
template <class Number>
int half_of(const Point<Number>& d) {
  return d.y > 0 || (d.y == 0 && d.x > 0) ? 0 : 1;
}

/// The directions of the edges, y up.
template <class Number>
std::vector<Point<Number>> directions(const Ring<Number>& ring) {
  std::vector<Point<Number>> result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
    result.push_back({Number(b.x - a.x), Number(a.y - b.y)});
  }
  return result;
}

template <class Number>
int turn_of(const Point<Number>& d, const Point<Number>& e) {
  return sign_of(Number(d.x * e.y - d.y * e.x));
}

/// Whole turns: how often the direction passes the positive x axis, counter-clockwise minus
/// clockwise, turning by less than π at each corner.
template <class Number>
std::optional<int> turning_number_of(const std::vector<Point<Number>>& d) {
  int number = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const auto &from = d[i], &to = d[(i + 1) % d.size()];
    const int turn = turn_of(from, to);
    if (turn == 0 && sign_of(Number(from.x * to.x + from.y * to.y)) <= 0) return std::nullopt;
    if (turn > 0 && half_of(from) == 1 && half_of(to) == 0) ++number;
    if (turn < 0 && half_of(from) == 0 && half_of(to) == 1) --number;
  }
  return number;
}

template <class Number>
bool all_corners_on_one_side(const Ring<Number>& ring) {
  bool some_left = false, some_right = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    check_interruption();
    for (const Point<Number>& p : ring) {
      const int side = sign_of(left_of(ring[i], ring[(i + 1) % ring.size()], p));
      some_left = some_left || side > 0;
      some_right = some_right || side < 0;
      if (some_left && some_right) return false;
    }
  }
  return true;
}

/// Whether p lies on the closed edge.
template <class Number>
bool is_on_edge(const Point<Number>& a, const Point<Number>& b, const Point<Number>& p) {
  return left_of(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

}  // namespace

template <class Number>
Number left_of(const Point<Number>& a, const Point<Number>& b, const Point<Number>& p) {
  return (b.y - a.y) * (p.x - a.x) - (b.x - a.x) * (p.y - a.y);
}

template <class Number>
bool is_on_one_side_of_every_edge(const Ring<Number>& ring, const Point<Number>& p) {
  bool some_left = false, some_right = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const int side = sign_of(left_of(ring[i], ring[(i + 1) % ring.size()], p));
    some_left = some_left || side > 0;
    some_right = some_right || side < 0;
  }
  return some_left != some_right;
}

template <class Number>
RayCrossings ray_crossings(const Rings<Number>& rings, const Point<Number>& p) {
  check_interruption();
  RayCrossings result;
  for (const Ring<Number>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
      result.on_outline = result.on_outline || is_on_edge(a, b, p);
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      const bool down = a.y < b.y;
      // The crossing is to the right of p if p is to the left of the edge, directed upwards.
      const int side = sign_of(down ? left_of(b, a, p) : left_of(a, b, p));
      if (side <= 0) continue;
      ++result.count;
      // An edge that runs down on the right of the point turns clockwise around it, as seen.
      result.winding += down ? -1 : 1;
    }
  }
  return result;
}

template <class Number>
Convexity convexity_of(const Ring<Number>& ring) {
  Convexity result;
  const auto d = directions(ring);
  bool left = false, right = false;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const int turn = turn_of(d[(i + d.size() - 1) % d.size()], d[i]);
    result.turns.push_back(turn);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  result.turning_number = turning_number_of(d);
  result.corners_on_one_side = all_corners_on_one_side(ring);
  const int around = result.turning_number.value_or(0);
  result.convex = left != right && (around == 1 || around == -1);
  return result;
}

template <class Number>
Ring<Number> convex_hull(std::vector<Point<Number>> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // First down the left as seen and to the right: with y down that is the chain of greatest y.
  Ring<Number> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && left_of(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // it begins the next chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

template <class Number>
bool is_in_hull(const Ring<Number>& hull, const Point<Number>& p) {
  check_interruption();
  if (hull.size() == 1) return p == hull[0];
  if (hull.size() == 2) return is_on_edge(hull[0], hull[1], p);
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (left_of(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
  return !hull.empty();
}

template <class Number>
Point<Number> combination(const std::vector<Point<Number>>& points,
                          const std::vector<Number>& weights) {
  Number x(0), y(0), sum(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    x += weights[i] * points[i].x;
    y += weights[i] * points[i].y;
    sum += weights[i];
  }
  return {Number(x / sum), Number(y / sum)};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                           \
  template Number left_of(const Point<Number>&, const Point<Number>&, const Point<Number>&); \
  template bool is_on_one_side_of_every_edge(const Ring<Number>&, const Point<Number>&);     \
  template RayCrossings ray_crossings(const Rings<Number>&, const Point<Number>&);           \
  template Convexity convexity_of(const Ring<Number>&);                                      \
  template Ring<Number> convex_hull(std::vector<Point<Number>>);                             \
  template bool is_in_hull(const Ring<Number>&, const Point<Number>&);                       \
  template Point<Number> combination(const std::vector<Point<Number>>&, const std::vector<Number>&);
FATHOM_INSTANTIATE(Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
