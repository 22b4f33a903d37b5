#pragma once

#include <optional>
#include <vector>

#include "fathom/area/remainder.h"

namespace fathom::area {

/// Parts of a convex polygon in a cell that are covered or hidden, one after the other, without
/// most of those that lie within the union of the ones before: in a crowd, most do.
class CoveredParts {
 public:
  CoveredParts(ImageCell& cell, ConvexPolygon whole) : cell_(&cell), whole_(std::move(whole)) {}

  /// Adds a part of the polygon. Returns false if the parts before certainly cover it, and then
  /// does not keep it.
  bool add(const ConvexPolygon& part);
  /// Whether the parts are certainly all of the polygon: what is added then changes nothing.
  [[nodiscard]] bool is_all() const { return is_all_; }
  /// Polygons with the same union as the parts; the polygon itself if they are all of it.
  [[nodiscard]] const std::vector<ConvexPolygon>& parts() const { return parts_; }

 private:
  void complete();

  ImageCell* cell_;
  ConvexPolygon whole_;
  std::vector<ConvexPolygon> parts_;
  /// What they leave, or more; once there are many.
  std::optional<Remainder> rest_;
  bool is_all_ = false;
};

}  // namespace fathom::area
