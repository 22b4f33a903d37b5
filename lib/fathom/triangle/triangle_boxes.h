#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/geometry/approximate_row.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {

/// Boxes of the triangles of one object: the pixels outside which a triangle covers no sample that
/// counts, as bounding_box() has them or a little larger. Corners are projected in binary64 with a
/// bound, exactly where the bound does not tell whether W > 0; once where triangles that follow
/// each other share them.
class TriangleBoxes {
 public:
  TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera);
  PixelBox box(std::uint32_t triangle);

 private:
  /// Columns and rows from first to last, one corner's image, or beyond the image's sides;
  /// `in_front`: W > 0, without which nothing else is set.
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
  /// The corner that was projected last, of those whose number has the same low bits.
  std::vector<Corner> recent_;
};

}  // namespace fathom::triangle
