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

/// The area of the union of what the regions cover of a cell.
class CellCoverage {
 public:
  explicit CellCoverage(ImageCell& cell) : cell_(cell), covered_(cell, cell.whole()) {}
  void add(const std::vector<LinearForm>& region);
  /// Whether the whole cell is covered: what is added then changes nothing.
  [[nodiscard]] bool is_complete() const { return covered_.is_all(); }
  [[nodiscard]] Ratio area();
  /// The area, rounded once.
  [[nodiscard]] float rounded_area();
  [[nodiscard]] const TierCounts& decisions() const { return counts_; }

 private:
  [[nodiscard]] Boundary boundary();

  ImageCell& cell_;
  CoveredParts covered_;
  TierCounts counts_;
};

}  // namespace fathom::area
