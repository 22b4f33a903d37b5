#include "fathom/mesh/triangulate_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <queue>

#include "fathom/mesh/planar_ring.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/standard_arithmetic.h"

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
    // The rest: one last triangle, or a fan if no ear is left.
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
    /// The list of the corners whose obstacle is this corner, and the neighbours in such a list.
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

/// Cuts ears off a ring that turns `way` and is simple except for corners that repeat the previous
/// corner (specification, section 3); appends the triangles. Exact.
///
/// Cost     about n log n for usual outlines. A corner that is not an ear is examined again only
///          when a neighbour is cut, or the obstacle: the corner in its triangle. The obstacle is
///          chosen at random, so n log n queries are expected for any ring. A query walks a tree:
///          log n steps for compact triangles, √n for long triangles among corners all over the
///          plane, and n at worst, if a long side passes through all boxes.
Triangulation clip_ears(const std::vector<Point2>& points, Sign way,
                        std::vector<std::array<Corner, 3>>& triangles) {
  return EarClipping(points, way).run(triangles);
}

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

/// exact_projection_axis() in binary64, or −2 if the error bounds do not decide.
///
/// Bound. With a, b relative to the first corner, each difference is rounded once, so each of the
/// 2(n−1) products carries a relative error of at most (1+u)³ − 1 < 3.01u, u = 2⁻⁵³, and the sum of
/// m = 2n terms one of at most (m−1)u more, relative to S = Σ |products|, which is at most
/// 1 + (m+3)u times what is computed for it. All told that is less than (m + 2.01)u + 2m²u², where
/// 2m²u² ≤ u/4 for n ≤ 2²⁴. Hence |error| ≤ (2n + 4)·u·S for n < 2²⁴. An underflowing product adds
/// at most 2⁻¹⁰⁷⁵ each; S ≥ 2⁻⁹⁰⁰ makes that less than u·S·2⁻¹⁰⁰, covered by the 4. An overflow
/// makes S infinite and is left to the exact test.
int filtered_projection_axis(std::span<const MeshPoint> ring) {
  if (ring.size() >= (std::size_t{1} << 24)) return -2;
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
  // The bounds are themselves rounded: the factor 1 + 2⁻²⁰ outweighs that many times over.
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
  return clip_ears(points, way_of(points, curve), triangles);
}

}  // namespace fathom::mesh
