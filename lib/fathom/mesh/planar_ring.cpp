#include "fathom/mesh/planar_ring.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace fathom::mesh {
namespace {

/// Rings of up to this many corners compare their edges pair by pair, without allocating memory.
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

namespace {

constexpr std::size_t most_in_leaf = 16;

}  // namespace

/// A closed triangle that turns one way, to be held against points and boxes.
class CornerTree::Triangle {
 public:
  Triangle(const Point2& a, const Point2& b, const Point2& c, Sign way)
      : corners_{&a, &b, &c}, outside_(-way) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      least_[axis] = std::min({a[axis], b[axis], c[axis]});
      greatest_[axis] = std::max({a[axis], b[axis], c[axis]});
    }
  }

  /// Whether p lies in the triangle, but not at a corner.
  [[nodiscard]] bool holds(const Point2& p) const {
    if (is_beside(p, p)) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (p == *corners_[k]) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (turn_of(*corners_[k], *corners_[(k + 1) % 3], p) == outside_) return false;
    return true;
  }

  /// Whether one of its sides, or an axis, separates it from the box.
  [[nodiscard]] bool misses(const Node& box) const {
    if (is_beside(box.least, box.greatest)) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 &a = *corners_[k], &b = *corners_[(k + 1) % 3];
      // The box's corner that lies farthest on the inner side of ab.
      const bool inner_is_left = outside_ == Sign::negative;
      const bool upper = (b[0] > a[0]) == inner_is_left, right = (b[1] < a[1]) == inner_is_left;
      const Point2 farthest{right ? box.greatest[0] : box.least[0],
                            upper ? box.greatest[1] : box.least[1]};
      if (turn_of(a, b, farthest) == outside_) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool is_beside(const Point2& least, const Point2& greatest) const {
    return greatest[0] < least_[0] || least[0] > greatest_[0] || greatest[1] < least_[1] ||
           least[1] > greatest_[1];
  }

  std::array<const Point2*, 3> corners_;
  Point2 least_{}, greatest_{};
  Sign outside_;
};

CornerTree::CornerTree(const std::vector<Point2>& points, std::vector<Corner> corners)
    : points_(points), list_(std::move(corners)), place_(points.size(), nowhere) {
  int depth = 0;
  while (list_.size() >> depth > most_in_leaf) ++depth;
  nodes_.resize((std::size_t{2} << depth) - 1);
  build({0, 0, list_.size()}, depth);
  for (std::size_t i = 0; i < list_.size(); ++i) place_[list_[i]] = static_cast<Corner>(i);
}

void CornerTree::build(const Range& range, int depth) {
  Node& node = nodes_[range.node];
  node.left = static_cast<std::uint32_t>(range.end - range.begin);
  if (node.left == 0) return;
  node.least = node.greatest = points_[list_[range.begin]];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      node.least[axis] = std::min(node.least[axis], points_[list_[i]][axis]);
      node.greatest[axis] = std::max(node.greatest[axis], points_[list_[i]][axis]);
    }
  }
  if (depth == 0) return;
  // Halves, so that no difference of finite numbers overflows.
  const auto extent = [&](std::size_t axis) {
    return node.greatest[axis] / 2 - node.least[axis] / 2;
  };
  const std::size_t axis = extent(1) > extent(0) ? 1 : 0;
  const auto at = [&](std::size_t i) { return list_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(range.middle()), at(range.end),
                   [&](Corner i, Corner k) { return points_[i][axis] < points_[k][axis]; });
  build({2 * range.node + 1, range.begin, range.middle()}, depth - 1);
  build({2 * range.node + 2, range.middle(), range.end}, depth - 1);
}

void CornerTree::remove(Corner corner) {
  const std::size_t place = std::exchange(place_[corner], nowhere);
  list_[place] = nowhere;
  Range range{0, 0, list_.size()};
  while (true) {
    --nodes_[range.node].left;
    if (is_leaf(range)) return;
    range = place < range.middle() ? Range{2 * range.node + 1, range.begin, range.middle()}
                                   : Range{2 * range.node + 2, range.middle(), range.end};
  }
}

std::optional<Corner> CornerTree::find_in(const Point2& a, const Point2& b, const Point2& c,
                                          Sign way) {
  const Triangle triangle(a, b, c, way);
  std::uint64_t lot = ++questions_;
  std::array<Range, 64> open;  // fewer than there are levels
  std::size_t count = 0;
  open[count++] = {0, 0, list_.size()};
  while (count > 0) {
    const Range range = open[--count];
    const Node& node = nodes_[range.node];
    if (node.left == 0 || (nodes_.size() > 1 && triangle.misses(node))) continue;
    if (!is_leaf(range)) {
      const Range left{2 * range.node + 1, range.begin, range.middle()};
      const Range right{2 * range.node + 2, range.middle(), range.end};
      lot = lot * 6364136223846793005U + 1;  // a linear congruential generator: its highest bit
      const bool left_first = lot >> 63 != 0;
      open[count++] = left_first ? right : left;
      open[count++] = left_first ? left : right;
      continue;
    }
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (list_[i] != nowhere && triangle.holds(points_[list_[i]])) return list_[i];
  }
  return std::nullopt;
}

}  // namespace fathom::mesh
