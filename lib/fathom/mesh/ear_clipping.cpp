#include "fathom/mesh/ear_clipping.h"

#include <functional>
#include <optional>
#include <queue>

#include "fathom/mesh/corner_tree.h"

namespace fathom::mesh {
namespace {

/// A queue holds the candidate ears in ring order. A corner that turns out not to be an ear waits
/// until a neighbour is cut or until the corner that lies in its triangle is cut.
///
/// Only corners that do not turn the ring's way need to be looked for in a triangle abc whose
/// middle corner b turns that way. Of the corners in it, which are at none of a, b, c, take one, q,
/// that is farthest from the line ac, towards b. No edge enters the part of the triangle beyond q:
/// none ends there, and the sides ab and bc, which are edges, are not crossed. So that part lies
/// inside the ring, and the edges at q leave it on the other side of the parallel through q to ac:
/// the ring is at least straight there. Once a corner turns the ring's way it does so until it is
/// cut, for what is cut is a part of its angle; only where the whole ring has no area is it
/// straight again, and there is no ear then.
class EarClipping {
 public:
  EarClipping(const std::vector<Point2>& points, Sign way)
      : points_(points), way_(way), corners_(ring_of(points.size())), not_turning_(tree()) {
    std::vector<Corner> all(points.size());
    for (Corner i = 0; i < all.size(); ++i) all[i] = i;
    may_be_ears_ = Queue({}, std::move(all));
  }

  Triangulation run(std::vector<std::array<Corner, 3>>& triangles) {
    std::size_t left = points_.size();
    while (left > 3 && !may_be_ears_.empty()) {
      const Corner i = may_be_ears_.top();
      may_be_ears_.pop();
      corners_[i].is_in_queue = false;
      if (!is_ear(i)) continue;
      triangles.push_back({corners_[i].previous, i, corners_[i].next});
      cut(i);
      --left;
    }
    // What is left: one last triangle, or, where there is no ear, a fan of it.
    const bool done = left == 3 && turn_at(corners_[first_].next) == way_;
    Corner a = corners_[first_].next;
    for (std::size_t k = 2; k < left; ++k, a = corners_[a].next)
      triangles.push_back({first_, a, corners_[a].next});
    return done ? Triangulation::ear_clipping : Triangulation::fallback_fan;
  }

 private:
  static constexpr Corner none = 0xFFFFFFFF;
  using Queue = std::priority_queue<Corner, std::vector<Corner>, std::greater<>>;

  struct RingCorner {
    Corner next, previous;
    /// A corner in its triangle; while there is one, this corner is in the list of that.
    Corner obstacle = none;
    /// The list of the corners of which this is the obstacle, and neighbours in such a list.
    Corner first_waiting = none, next_waiting = none, previous_waiting = none;
    bool is_in_queue = true;
  };

  static std::vector<RingCorner> ring_of(std::size_t n) {
    std::vector<RingCorner> ring(n);
    for (std::size_t i = 0; i < n; ++i) {
      ring[i].next = static_cast<Corner>(i + 1 == n ? 0 : i + 1);
      ring[i].previous = static_cast<Corner>(i == 0 ? n - 1 : i - 1);
    }
    return ring;
  }

  [[nodiscard]] CornerTree tree() const {
    std::vector<Corner> not_turning;
    for (Corner i = 0; i < points_.size(); ++i)
      if (turn_at(i) != way_) not_turning.push_back(i);
    return {points_, std::move(not_turning)};
  }

  [[nodiscard]] Sign turn_at(Corner i) const {
    return turn_of(points_[corners_[i].previous], points_[i], points_[corners_[i].next]);
  }

  bool is_ear(Corner i) {
    if (not_turning_.contains(i)) return false;
    const Point2 &before = points_[corners_[i].previous], &behind = points_[corners_[i].next];
    // Straight again: the ring has no area.
    if (turn_at(i) != way_) return false;
    const std::optional<Corner> obstacle = not_turning_.find_in(before, points_[i], behind, way_);
    if (obstacle) wait_for(i, *obstacle);
    return !obstacle;
  }

  void wait_for(Corner i, Corner obstacle) {
    RingCorner& corner = corners_[i];
    Corner& first = corners_[obstacle].first_waiting;
    corner.obstacle = obstacle;
    corner.previous_waiting = none;
    corner.next_waiting = first;
    if (first != none) corners_[first].previous_waiting = i;
    first = i;
  }

  void stop_waiting(Corner i) {
    RingCorner& corner = corners_[i];
    if (corner.obstacle == none) return;
    if (corner.next_waiting != none)
      corners_[corner.next_waiting].previous_waiting = corner.previous_waiting;
    if (corner.previous_waiting != none)
      corners_[corner.previous_waiting].next_waiting = corner.next_waiting;
    else
      corners_[corner.obstacle].first_waiting = corner.next_waiting;
    corner.obstacle = none;
  }

  void look_again_at(Corner i) {
    stop_waiting(i);
    if (corners_[i].is_in_queue) return;
    corners_[i].is_in_queue = true;
    may_be_ears_.push(i);
  }

  void cut(Corner ear) {
    const Corner before = corners_[ear].previous, behind = corners_[ear].next;
    corners_[before].next = behind;
    corners_[behind].previous = before;
    if (first_ == ear) first_ = behind;
    while (corners_[ear].first_waiting != none) look_again_at(corners_[ear].first_waiting);
    for (const Corner neighbour : {before, behind}) {
      look_again_at(neighbour);
      if (not_turning_.contains(neighbour) && turn_at(neighbour) == way_)
        not_turning_.remove(neighbour);
    }
  }

  const std::vector<Point2>& points_;
  Sign way_;
  std::vector<RingCorner> corners_;
  /// The corners that do not turn the ring's way.
  CornerTree not_turning_;
  Queue may_be_ears_;
  /// The first corner that is left.
  Corner first_ = 0;
};

}  // namespace

Triangulation clip_ears(const std::vector<Point2>& points, Sign way,
                        std::vector<std::array<Corner, 3>>& triangles) {
  return EarClipping(points, way).run(triangles);
}

}  // namespace fathom::mesh
