#include "fathom/fast/coverage/pixel_union.h"

#include <algorithm>
#include <cmath>

#include "fathom/fast/coverage/area_bounds.h"

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
// The measure of a union of spans changes by no more than one of its ends is moved.
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

// Corners where the computed f is not negative stay. So whatever is cut off or kept by mistake has
// |exact f| ≤ 2·error + (|a| + |b|)·8u: a strip across the square with a width of at most twice
// that over max(|a|, |b|), and a length of at most √2.
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

}  // namespace fathom::fast
