#pragma once

#include <limits>
#include <vector>

#include "fathom/area/image_cell.h"

namespace fathom::area {

/// What polygons leave of a convex polygon in a cell, as convex polygons without a common area.
class Remainder {
 public:
  /// So many parts are quickly looked at.
  static constexpr std::size_t simple = 16;

  Remainder(ImageCell& cell, ConvexPolygon whole) : cell_(&cell), parts_{std::move(whole)} {}

  [[nodiscard]] const std::vector<ConvexPolygon>& parts() const { return parts_; }
  [[nodiscard]] bool is_empty() const { return parts_.empty(); }
  /// Whether the polygon and the remainder have an area in common.
  [[nodiscard]] bool meets(const ConvexPolygon& polygon) const;

  /// Takes a polygon away, exactly. If that would leave more than `most` parts, nothing is taken
  /// away: then the remainder is more than what is left.
  void subtract(const ConvexPolygon& polygon,
                std::size_t most = std::numeric_limits<std::size_t>::max());

 private:
  ImageCell* cell_;
  std::vector<ConvexPolygon> parts_;
};

}  // namespace fathom::area
