#include "fathom/mesh/corner_tree.h"

#include <algorithm>
#include <utility>

namespace fathom::mesh {
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

  /// Whether p lies in it, at none of its corners.
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
