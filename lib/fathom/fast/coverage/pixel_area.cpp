#include "fathom/fast/coverage/pixel_area.h"

#include <algorithm>
#include <cmath>

#include "fathom/fast/coverage/square_edges.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::fast {

void PixelUnion::clear() {
  edges_.clear();
  polygons_ = 0;
  error_ = 0;
}

void PixelUnion::add(std::span<const SquarePoint> corners, double area_error) {
  error_ += area_error;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges_.add(corners[i], corners[i + 1 == corners.size() ? 0 : i + 1], polygons_);
  }
  ++polygons_;
}

// A line crosses the boundary of each polygon twice or not at all; between the two it is inside.
// The measure of a union of spans changes by at most the distance by which one of its ends is
// moved.
double PixelUnion::covered_length(std::span<const SquareEdges::Crossing> crossings) {
  is_inside_.assign(static_cast<std::size_t>(polygons_), false);
  double length = 0, left = 0;
  int number = 0;
  for (const SquareEdges::Crossing& crossing : crossings) {
    const double right = std::clamp(crossing.x, 0.0, 1.0);
    if (number > 0) length += right - left;
    left = right;
    char& is_inside = is_inside_[static_cast<std::size_t>(crossing.tag)];
    number += is_inside ? -1 : 1;
    is_inside = !is_inside;
  }
  return number > 0 ? length + (1 - left) : length;
}

Interval PixelUnion::area() {
  const double sum = edges_.integrate(
      [](const SquareEdges::Strip&) { return -1.0; },
      [&](const SquareEdges::Slab& slab) { return covered_length(slab.crossings); });
  const double bound = (error_ + edges_.error(sum)) * (1 + 0x1p-20);
  return {std::max(sum - bound, 0.0), std::min(sum + bound, 1.0)};
}

// Corners where the computed f is not negative remain. So any part that is cut off or kept by
// mistake has |exact f| ≤ 2·error + (|a| + |b|)·8u: a strip across the square with a width of at
// most twice that over max(|a|, |b|), and a length of at most √2.
void ClippedSquare::clip(const UncertainHalfPlane& h) {
  std::array<double, most> f{};
  bool all_inside = true, all_outside = true;
  for (std::size_t i = 0; i < count_; ++i) {
    f[i] = h.c + h.a * corners_[i].x + h.b * corners_[i].y;
    all_inside = all_inside && f[i] > h.error;
    all_outside = all_outside && f[i] < -h.error;
  }
  if (all_inside || count_ == 0) return;
  if (all_outside) {
    count_ = 0;
    return;
  }
  const double slope = std::max(std::abs(h.a), std::abs(h.b));
  area_error_ +=
      slope > 0 ? area_bounds::cut_error * h.error / slope + area_bounds::cut_rounding : 1;
  std::array<SquarePoint, most> kept{};
  std::size_t kept_count = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t next = i + 1 == count_ ? 0 : i + 1;
    const SquarePoint &p = corners_[i], &q = corners_[next];
    if (f[i] >= 0) kept[kept_count++] = p;
    if ((f[i] >= 0) == (f[next] >= 0)) continue;
    const double t = f[i] / (f[i] - f[next]);
    kept[kept_count++] = {p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t};
  }
  corners_ = kept;
  count_ = kept_count;
}

// Let the corners of all triangles go straight from their exact to their computed places, by at
// most ε in each coordinate. At the start the sum of the triangles' winding numbers around a point
// is the number of triangles that cover it. Cancelled edges cancel all the way, so the sum changes
// only where an edge that is left passes over the point, which is then within r = √2·ε of that
// edge. Within the square such a strip has an area of at most 2r·(√2 + 2r) ≤ 4.1ε, and of at most
// 2rl + πr², l being the length of the edge within r of the square. Everywhere else
// the winding number of the computed edges is the exact number of triangles; in particular at a
// point where that number is certain for all points within ε.
//
// From there it follows everywhere else. Let each edge be bent so that it passes the middles of
// slabs where its crossings are computed: that moves it by at most ξ, and no end. The number just
// to the left of x = 0 changes from one middle to another exactly where bent edges pass it in
// between, and along a middle at the crossings as computed. The point whose number is known is more
// than 2ξ away from any crossing, so it has the same number with bent edges.
//
// The length of the points with a positive winding number changes by at most the distance by which
// a crossing is moved, and crossings at the same place may have any order: square_edges.h.

namespace {

/// Not less than the length of the segment within `margin` of the square in both coordinates.
/// Shares of the segment and its length err by 8u together.
/// Source   [LB84]
double length_near_square(const SquarePoint& p, const SquarePoint& q, double margin) {
  double first = 0, last = 1;
  const auto clip = [&](double start, double change) {
    if (change == 0) {
      if (start < -margin || start > 1 + margin) last = 0;
      return;
    }
    const double a = (-margin - start) / change, b = (1 + margin - start) / change;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  const double dx = q.x - p.x, dy = q.y - p.y;
  clip(p.x, dx);
  clip(p.y, dy);
  const double w = std::abs(dx), h = std::abs(dy);
  // At least √(w² + h²).
  const double length = std::max(w, h) + std::min(w, h) / 2;
  return (std::max(last - first, 0.0) + 16 * unit_roundoff<double>)*length;
}

/// The area in the square that an edge passes over while its ends move by at most `error` in each
/// coordinate.
double area_passed(const SquarePoint& p, const SquarePoint& q, double error) {
  const double length = length_near_square(p, q, 2 * error);
  return error * std::min(area_bounds::moved_edge,
                          area_bounds::moved_length * length + area_bounds::moved_end * error);
}

}  // namespace

void PixelWinding::clear() {
  added_.clear();
  error_ = 0;
}

// Many surfaces may have an edge in one place. Each adds its error, as each has exact ends of its
// own; the computed edges are one line, across which the winding number changes by all of them.
void PixelWinding::add(const SquarePoint& from, const SquarePoint& to, double position_error,
                       int times) {
  error_ += area_passed(from, to, position_error);
  const bool in_order = from.x < to.x || (from.x == to.x && from.y <= to.y);
  const Added edge = in_order ? Added{from, to, times} : Added{to, from, -times};
  const auto same = std::find_if(added_.rbegin(), added_.rend(), [&](const Added& other) {
    return other.first.x == edge.first.x && other.first.y == edge.first.y &&
           other.second.x == edge.second.x && other.second.y == edge.second.y;
  });
  if (same == added_.rend()) {
    added_.push_back(edge);
  } else {
    same->times += edge.times;
  }
}

// With x to the right and y downwards, a triangle of positive area lies to the left of its edges
// that go down and to the right of its edges that go up. An edge with both ends beyond the left
// side bounds no length in the square, and never passes that side.
void PixelWinding::set_edges() {
  edges_.clear();
  for (const auto& [first, second, times] : added_) {
    if (times == 0 || (first.x < 0 && second.x < 0)) continue;
    edges_.add(first, second, first.y < second.y ? -times : times);
  }
}

PixelWinding::Gap PixelWinding::widest_gap(Crossings crossings) {
  Gap widest{0, 0, -1};
  double left = 0;
  for (std::size_t i = 0; i <= crossings.size(); ++i) {
    const double right = i == crossings.size() ? 1 : std::clamp(crossings[i].x, 0.0, 1.0);
    if (right - left > widest.width) widest = {i, left, right - left};
    left = right;
  }
  return widest;
}

int PixelWinding::number_at_side(Crossings crossings, const Gap& gap, int number) {
  for (const SquareEdges::Crossing& crossing : crossings.first(gap.place)) {
    if (!crossing.is_left) number -= crossing.tag;
  }
  return number;
}

double PixelWinding::covered_length(Crossings crossings, int number_at_side) {
  int number = number_at_side;
  double length = 0, left = 0;
  for (const SquareEdges::Crossing& crossing : crossings) {
    if (crossing.is_left) continue;
    const double right = std::min(crossing.x, 1.0);
    if (number > 0) length += right - left;
    number += crossing.tag;
    left = right;
  }
  return number > 0 ? length + (1 - left) : length;
}

Interval PixelWinding::enclose(double sum) const {
  const double bound = (error_ + edges_.error(sum)) * (1 + 0x1p-20);
  return {std::max(sum - bound, 0.0), std::min(sum + bound, 1.0)};
}

}  // namespace fathom::fast
