#pragma once

#include <algorithm>
#include <cmath>

#include "fathom/numeric/standard_arithmetic.h"

/// Signs on the plane that hold for certain: each point has a bound on the error of its
/// coordinates, and a sign that the bounds do not settle is unknown. Nothing here is exact; callers
/// only ever conclude from a certain sign.
namespace fathom::area {

/// A point of the plane within `error` of (u, v), in each coordinate.
struct BoundedPoint {
  double u = 0, v = 0, error = 0;
};

/// A rectangle of the plane. Its corners are exact.
struct PlanePart {
  double left = 0, top = 0, right = 0, bottom = 0;

  [[nodiscard]] BoundedPoint corner(std::size_t k) const {
    return {k % 2 == 0 ? left : right, k < 2 ? top : bottom, 0};
  }
};

/// A box that certainly contains some points.
struct PlaneBox {
  double left, top, right, bottom;

  explicit PlaneBox(const BoundedPoint& p)
      : left(p.u - p.error), top(p.v - p.error), right(p.u + p.error), bottom(p.v + p.error) {
    widen();
  }
  PlaneBox(const BoundedPoint& p, const BoundedPoint& q) : PlaneBox(p) { add(PlaneBox(q)); }
  PlaneBox(const BoundedPoint& p, const BoundedPoint& q, const BoundedPoint& r) : PlaneBox(p, q) {
    add(PlaneBox(r));
  }

  /// Whether it has no point in common with a PlanePart or another box.
  template <class Rectangle>
  [[nodiscard]] bool misses(const Rectangle& other) const {
    return right < other.left || left > other.right || bottom < other.top || top > other.bottom;
  }
  [[nodiscard]] bool is_inside(const PlanePart& part) const {
    return left > part.left && right < part.right && top > part.top && bottom < part.bottom;
  }

 private:
  void add(const PlaneBox& other) {
    left = std::min(left, other.left);
    top = std::min(top, other.top);
    right = std::max(right, other.right);
    bottom = std::max(bottom, other.bottom);
  }
  /// By more than the roundings of the four sums.
  void widen() {
    const auto by = [](double x) { return 0x1p-52 * std::abs(x) + 0x1p-1000; };
    left -= by(left);
    top -= by(top);
    right += by(right);
    bottom += by(bottom);
  }
};

/// The certain sign of (q − p) × (c − p): 1 if c lies on the side of the line from p to q on which
/// triangles of positive area lie, −1 on the other side, 0 if it is not certain.
///
/// With ρ the sum of the three errors, each difference a, b, c, d errs by at most ρ + ε of itself.
/// So a product errs by at most ρ(|a| + |d|) + 2ε|ad| + ρ² with terms of second order, and by ε|ad|
/// when it is rounded; the difference of the products by ε of their sum. 4ε is therefore enough but
/// for terms of second order, which 5ε and 3ρ² include.
inline int certain_side(const BoundedPoint& p, const BoundedPoint& q, const BoundedPoint& at) {
  constexpr double epsilon = unit_roundoff<double>;
  const double a = q.u - p.u, b = q.v - p.v, c = at.u - p.u, d = at.v - p.v;
  const double rho = p.error + q.error + at.error;
  const double ad = a * d, bc = b * c, value = ad - bc;
  const double sizes = std::abs(a) + std::abs(b) + std::abs(c) + std::abs(d);
  const double error =
      (rho * sizes + 3 * rho * rho + 5 * epsilon * (std::abs(ad) + std::abs(bc))) * (1 + 0x1p-40) +
      0x1p-1000;
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// Whether the part certainly lies on the given side of the line from p to q.
inline bool lies_on_side(const PlanePart& part, const BoundedPoint& p, const BoundedPoint& q,
                         int side) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (certain_side(p, q, part.corner(k)) != side) return false;
  }
  return true;
}

/// Whether the segment from p to q certainly has no point in the part.
inline bool misses(const PlanePart& part, const BoundedPoint& p, const BoundedPoint& q) {
  if (PlaneBox(p, q).misses(part)) return true;
  const int side = certain_side(p, q, part.corner(0));
  return side != 0 && lies_on_side(part, p, q, side);
}

}  // namespace fathom::area
