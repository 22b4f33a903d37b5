#pragma once

#include "fathom/area/convex_union.h"
#include "fathom/area/image_cell.h"

namespace fathom::area {

/// How far one triangle lies behind another, D_behind − D_front in scene units, over a part of a
/// cell where both cover every point and this is not negative.
class Separation {
 public:
  Separation(const ImageCell& cell, const SurfaceRegion& front, const SurfaceRegion& behind);

  /// Whether it is below `limit`, or at most `limit`, at a point of the boundary (closed).
  [[nodiscard]] bool is_below(const Boundary& boundary, const Dyadic& limit) const;
  [[nodiscard]] bool is_at_most(const Boundary& boundary, const Dyadic& limit) const;
  /// Whether it equals the limit everywhere.
  [[nodiscard]] bool is_constantly(const Dyadic& limit) const;

  /// Its least value over a boundary, rounded once to binary64.
  [[nodiscard]] double least(const Boundary& boundary) const;

 private:
  /// An affine form on the cell, at the cell's own scale.
  struct Form {
    ExactVector3 exact;
    [[nodiscard]] Dyadic at(const ExactVector3& point) const { return dot(exact, point); }
  };
  /// The forms at both ends of a segment, each times a positive weight.
  struct Ends;
  [[nodiscard]] Ends ends_of(const BoundarySegment& segment) const;
  [[nodiscard]] static bool reaches(const Ends& ends, const Dyadic& limit, bool closed);

  Form front_numerator_, front_weight_, behind_numerator_, behind_weight_;
  /// Whether both lie in one plane.
  bool is_zero_;
};

}  // namespace fathom::area
