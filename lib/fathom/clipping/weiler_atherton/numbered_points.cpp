#include "fathom/clipping/weiler_atherton/numbered_points.h"

#include <algorithm>

#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

/// −1, 0 or 1 as a is less than, equal to or greater than b; their bounds settle most comparisons.
template <class Number>
int compare(const Number& a, const Bounds& a_bounds, const Number& b, const Bounds& b_bounds) {
  if (a_bounds.is_below(b_bounds)) return -1;
  if (b_bounds.is_below(a_bounds)) return 1;
  if (a_bounds.is_exact() && b_bounds.is_exact()) return 0;
  return a < b ? -1 : a == b ? 0 : 1;
}

template <class Number>
struct BoxedPoint {
  const Point2<Number>* point;
  Box box;
  /// Where it stands among all corners of all rings.
  std::size_t place;
};

template <class Number>
int compare(const BoxedPoint<Number>& a, const BoxedPoint<Number>& b) {
  const int by_x = compare(a.point->x, a.box.x, b.point->x, b.box.x);
  return by_x != 0 ? by_x : compare(a.point->y, a.box.y, b.point->y, b.box.y);
}

template <class Number>
std::vector<Box> boxes_of(const std::vector<Point2<Number>>& points) {
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const Point2<Number>& p : points) {
    check_interruption();
    boxes.push_back(box_of(p));
  }
  return boxes;
}

}  // namespace

PointOrder::PointOrder(const std::vector<Point2<double>>& points) : boxes_(boxes_of(points)) {}

PointOrder::PointOrder(const std::vector<Point2<Rational>>& points)
    : boxes_(boxes_of(points)), exact_(points) {}

int PointOrder::turn(std::size_t a, std::size_t b, std::size_t c) const {
  if (const auto settled = settled_sign_of_cross(boxes_[a], boxes_[b], boxes_[c])) return *settled;
  return sign_of(cross(exact_[a], exact_[b], exact_[c]));
}

bool PointOrder::comes_before(std::size_t P, std::size_t a, std::size_t b) const {
  if (a == b) return false;
  const bool a_rises = a > P, b_rises = b > P;
  return a_rises != b_rises ? a_rises : turn(P, a, b) > 0;
}

bool PointOrder::is_between(std::size_t P, std::size_t a, std::size_t b, std::size_t c) const {
  if (comes_before(P, a, c)) return comes_before(P, a, b) && comes_before(P, b, c);
  return comes_before(P, a, b) || comes_before(P, b, c);
}

template <class Number>
NumberedCorners<Number> numbered(const Rings<Number>& rings) {
  std::vector<BoxedPoint<Number>> corners;
  for (const Ring<Number>& ring : rings)
    for (const Point2<Number>& p : ring) corners.push_back({&p, box_of(p), corners.size()});
  OccasionalInterruption check;
  std::sort(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
    check();
    return compare(a, b) < 0;
  });

  NumberedCorners<Number> result;
  std::vector<std::size_t> number_at(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    check_interruption();
    if (i == 0 || compare(corners[i - 1], corners[i]) != 0)
      result.points.push_back(*corners[i].point);
    number_at[corners[i].place] = result.points.size() - 1;
  }
  std::size_t place = 0;
  for (const Ring<Number>& ring : rings) {
    NumberedRing& numbers = result.rings.emplace_back(ring.size());
    for (std::size_t& number : numbers) number = number_at[place++];
  }
  return result;
}

int direction_of(const NumberedRing& ring, const PointOrder& points) {
  const auto least =
      static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
  return points.turn(preceding(ring, least), ring[least], following(ring, least));
}

template NumberedCorners<double> numbered(const Rings<double>&);
template NumberedCorners<Rational> numbered(const Rings<Rational>&);

}  // namespace fathom::clipping
