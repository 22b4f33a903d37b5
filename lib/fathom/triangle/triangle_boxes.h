#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/geometry/approximate_row.h"
#include "fathom/geometry/pixel_box.h"
#include "fathom/scene/scene.h"

namespace fathom::triangle {

/// Boxes of the triangles of one object: outside its box a triangle covers no sample that counts.
/// Equal to bounding_box() or a little larger. Corners are projected in binary64 with a bound, or
/// exactly where the bound leaves open whether W > 0; only once where consecutive triangles share
/// them.
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
  /// The corner that was projected last among those whose numbers have the same low bits.
  std::vector<Corner> recent_;
};

}  // namespace fathom::triangle
