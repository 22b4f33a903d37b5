#pragma once

#include <array>
#include <cstdint>

#include "fathom/geometry/approximate_row.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {

/// On which sides of a sample (u, v) the vertices of an object lie: the signs of U − uW and V − vW,
/// in binary64 with a bound.
///
/// A triangle whose corners share a side does not cover the sample. With corners a, b, c as
/// (U, V, W), edge functions e at the sample s = (u, v, 1) satisfy e_A·a + e_B·b + e_C·c = Δ·s.
/// The form f(p) = U − uW is 0 at s, so that e_A·f(a) + e_B·f(b) + e_C·f(c) = 0. A triangle that
/// covers s has edge functions of the sign of Δ ≠ 0 or 0, not all of them 0. So f cannot have one
/// strict sign at all three corners, wherever these lie, also behind the camera.
class SampleSides {
 public:
  /// A set of sides that are certain, one bit each: left, right, above, below.
  using Sides = std::uint8_t;

  SampleSides(const Object& object, const Camera& camera, const ImagePoint& s);
  [[nodiscard]] Sides of(const MeshPoint& p) const;

 private:
  /// U − uW and V − vW.
  std::array<ApproximateRow, 2> rows_;
};

}  // namespace fathom::triangle
