#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fathom/numeric/interval.h"
#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/walk_ray.h"

namespace fathom::rays {

/// A triangle that the ray is not certain to miss: w = n·d and n·t in binary64 with the bounds of
/// ray_bounds.h.
struct TestedTriangle {
  std::uint32_t number = 0;
  /// Where the tree has it (RayTree::corners).
  std::size_t place = 0;
  /// Whether it is certain that the ray meets the triangle, at some t.
  bool is_met = false;
  double w = 0, height = 0;
  /// Bounds on their errors; that of w bounds the weights, too.
  double error = 0, height_error = 0;

  /// Contains the s where the ray meets the plane. With x = height/w and the exact X,
  /// │x − X│ ≤ (E_t + │x│·E)/(│w│ − E); the division and the ends lose less than 4u of x.
  [[nodiscard]] Interval s() const {
    const double room = std::abs(w) - error;
    if (!(room > 0)) return {-infinity, infinity};
    const double s = height / w;
    const double s_error =
        ((height_error + std::abs(s) * error) / room + 4 * unit_roundoff<double> * std::abs(s)) *
            bounds::slack +
        bounds::floor;
    return {s - s_error, s + s_error};
  }
};

/// Receives the triangles that a walk along a ray finds (cast_lanes.h).
class TriangleVisitor {
 public:
  TriangleVisitor() = default;
  TriangleVisitor(const TriangleVisitor&) = delete;
  TriangleVisitor& operator=(const TriangleVisitor&) = delete;
  virtual ~TriangleVisitor() = default;

  /// Returns whether the answer is known, so that the walk can end.
  virtual bool offer(const TestedTriangle& triangle) = 0;
  /// Nothing beyond this s can change the answer.
  [[nodiscard]] float last() const { return last_; }

 protected:
  void set_last(float last) { last_ = last; }

 private:
  float last_ = 0;
};

}  // namespace fathom::rays
