#include "fathom/fast/coverage/pixel_union.h"

#include <algorithm>
#include <cmath>

#include "fathom/fast/coverage/area_bounds.h"
#include "fathom/fast/vertex.h"

namespace fathom::fast {
namespace {

double within_square(double x) {
  return x < 0 ? 0 : x > 1 ? 1 : x;
}

}  // namespace

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

// The measure of a union of spans changes by no more than one of its ends is moved.
double PixelUnion::length_at(double height) {
  constexpr Span none{2, -1};
  of_polygon_.assign(static_cast<std::size_t>(polygons_), none);
  for (const SquareEdges::Edge& edge : edges_.edges()) {
    if (!(edge.low < height && height < edge.high)) continue;
    const double x = within_square(edge.at(height));
    Span& span = of_polygon_[static_cast<std::size_t>(edge.tag)];
    span.left = std::min(span.left, x);
    span.right = std::max(span.right, x);
  }
  spans_.clear();
  for (const Span& span : of_polygon_) {
    if (!(span.left < span.right)) continue;
    if (span.left == 0 && span.right == 1) return 1;
    auto place = spans_.end();
    while (place != spans_.begin() && std::prev(place)->left > span.left) --place;
    spans_.insert(place, span);
  }
  double length = 0, reached = 0;
  for (const Span& span : spans_) {
    if (span.right <= reached) continue;
    length += span.right - std::max(span.left, reached);
    reached = span.right;
  }
  return length;
}

// A line crosses the boundary of each polygon at most twice.
Interval PixelUnion::area() {
  edges_.cut(true);
  const double sum = edges_.integrate([&](double height) { return length_at(height); });
  const double bound =
      (error_ + edges_.error_of(2 * static_cast<std::size_t>(polygons_))) * (1 + 0x1p-20);
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
