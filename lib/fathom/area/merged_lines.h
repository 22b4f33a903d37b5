#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>

#include "fathom/area/convex_polygon.h"

namespace fathom::area {

/// Half-planes of which equal ones are one object, so that edges that lie in one line are known by
/// their addresses. Lines of the same points come from triangles that are equal, share an edge, or
/// lie in a row, with coefficients that differ by a factor.
/// Exact    always: two are one if and only if they have the same points.
class MergedLines {
 public:
  MergedLines() = default;
  MergedLines(const MergedLines&) = delete;
  MergedLines& operator=(const MergedLines&) = delete;

  /// The one that stands for all with the points of h. It stays where it is; h is remembered by its
  /// address and must do so, too.
  const HalfPlane& of(const HalfPlane& h);
  /// The one on the other side of the line of h.
  const HalfPlane& opposite(const HalfPlane& h);
  /// The same polygon, bounded by those.
  ConvexPolygon of(const ConvexPolygon& polygon);

 private:
  const HalfPlane& find(const ExactVector3& coefficients);

  std::deque<HalfPlane> lines_;
  std::unordered_multimap<std::size_t, const HalfPlane*> by_hash_;
  std::unordered_map<const HalfPlane*, const HalfPlane*> known_, opposites_;
};

}  // namespace fathom::area
