#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/geometry/approximate_row.h"
#include "fathom/geometry/frames.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"

/// Bounds on the pixels that a triangle covers: its box, and tests whether it lies wholly to one
/// side of a sample.
namespace fathom::triangle {

/// U, V and W of the image of a point of an object's mesh, as exact affine functions of that point:
/// the coefficients of x, y, z and 1.
std::array<std::array<Dyadic, 4>, 3> image_rows(const Object& object, const Camera& camera);

/// Boxes of the triangles of one object: outside its box a triangle covers no sample that counts.
/// Equal to bounding_box() or a little larger. Corners are projected in binary64 with a bound, or
/// exactly if the bound leaves open whether W > 0. Corners that consecutive triangles share are
/// projected once.
class TriangleBoxes {
 public:
  TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera);
  PixelBox box(std::uint32_t triangle);

 private:
  /// First and last column and row of one corner's image, or beyond the image's sides; nothing else
  /// is set unless `in_front`: W > 0.
  struct Corner {
    std::uint32_t vertex = 0;
    bool known = false, in_front = false;
    std::int64_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;
  };
  const Corner& corner(std::uint32_t vertex);
  void project(const MeshPoint& p, Corner& corner) const;
  void project_exactly(const MeshPoint& p, Corner& corner) const;
  void set_place(const Interval& U, const Interval& V, const Interval& W, Corner& corner) const;

  const Object& object_;
  const Mesh& mesh_;
  const Camera& camera_;
  /// U, V and W.
  std::array<ApproximateRow, 3> rows_;
  /// The last projected corner of those whose numbers have the same low bits.
  std::vector<Corner> recent_;
};

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
