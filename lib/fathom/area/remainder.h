#pragma once

#include <limits>
#include <optional>
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

/// A polygon of which parts are hidden, one after the other.
class PartlyHidden {
 public:
  PartlyHidden(ImageCell& cell, const ConvexPolygon& polygon) : cell_(&cell), polygon_(polygon) {}

  /// Whether the hidden parts are certainly all of it.
  [[nodiscard]] bool is_hidden() const { return is_hidden_; }
  /// Returns whether this may hide more than the parts before.
  bool hide(const ConvexPolygon& part);

 private:
  ImageCell* cell_;
  ConvexPolygon polygon_;
  bool is_hidden_ = false;
  /// The first parts; then what all of them leave, or more.
  std::vector<ConvexPolygon> parts_;
  std::optional<Remainder> rest_;
};

}  // namespace fathom::area
