#pragma once

#include <vector>

/// Points, segments and rings over a kernel: Number is double (every operation rounded to binary64)
/// or Rational (exact_kernel.h, nothing rounded). y grows upwards wherever left, right, top or
/// counter-clockwise is mentioned.
namespace fathom::clipping {

template <class Number>
struct Point2 {
  Number x, y;

  friend bool operator==(const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }
  /// Lexicographic; along any line this is an order of its points.
  friend bool operator<(const Point2& a, const Point2& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  }
};

template <class Number>
struct Point3 {
  Number x, y, z;
};

/// A homogeneous point: (x/w, y/w, z/w) if w ≠ 0, a direction if w = 0.
template <class Number>
struct Point4 {
  Number x, y, z, w;
};

template <class Number>
struct Segment2 {
  Point2<Number> start, end;
};

/// The corners of a closed polyline; the first is not repeated.
template <class Number>
using Ring = std::vector<Point2<Number>>;

/// The rings of a polygon, outlines and holes, read by the even-odd rule.
template <class Number>
using Rings = std::vector<Ring<Number>>;

/// Twice the signed area of the triangle a, b, c: positive if c lies left of a → b.
template <class Number>
Number cross(const Point2<Number>& a, const Point2<Number>& b, const Point2<Number>& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

template <class Number>
int sign_of(const Number& value) {
  return (value > 0) - (value < 0);
}

/// Start + t (end − start), coordinate by coordinate.
template <class Number>
Number interpolate(const Number& start, const Number& end, const Number& t) {
  return start + t * (end - start);
}

template <class Number>
Point2<Number> interpolate(const Point2<Number>& a, const Point2<Number>& b, const Number& t) {
  return {interpolate(a.x, b.x, t), interpolate(a.y, b.y, t)};
}

template <class Number>
Point3<Number> interpolate(const Point3<Number>& a, const Point3<Number>& b, const Number& t) {
  return {interpolate(a.x, b.x, t), interpolate(a.y, b.y, t), interpolate(a.z, b.z, t)};
}

template <class Number>
Point4<Number> interpolate(const Point4<Number>& a, const Point4<Number>& b, const Number& t) {
  return {interpolate(a.x, b.x, t), interpolate(a.y, b.y, t), interpolate(a.z, b.z, t),
          interpolate(a.w, b.w, t)};
}

/// A clip rectangle [xmin, xmax] × [ymin, ymax], including its border; xmin ≤ xmax, ymin ≤ ymax.
template <class Number>
struct Window {
  Number xmin, ymin, xmax, ymax;
};

/// Throws InputError unless xmin ≤ xmax and ymin ≤ ymax.
template <class Number>
void check_window(const Window<Number>& window);

}  // namespace fathom::clipping
