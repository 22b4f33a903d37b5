#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "fathom/area/image_cell.h"

namespace fathom::area {

/// A convex polygon in a cell minus other polygons, as convex polygons without a common area.
class Remainder {
 public:
  /// A number of parts that is examined quickly.
  static constexpr std::size_t simple = 16;

  Remainder(ImageCell& cell, ConvexPolygon whole) : cell_(&cell), parts_{std::move(whole)} {}

  [[nodiscard]] const std::vector<ConvexPolygon>& parts() const { return parts_; }
  [[nodiscard]] bool is_empty() const { return parts_.empty(); }
  /// Whether the polygon and the remainder have an area in common.
  [[nodiscard]] bool meets(const ConvexPolygon& polygon) const;

  /// Subtracts a polygon, exactly. If more than `most` parts would remain, subtracts nothing: then
  /// the remainder is larger than the exact difference.
  void subtract(const ConvexPolygon& polygon,
                std::size_t most = std::numeric_limits<std::size_t>::max());

 private:
  ImageCell* cell_;
  std::vector<ConvexPolygon> parts_;
};

/// Covered or hidden parts of a convex polygon in a cell, in the order of addition. Most parts that
/// lie within the union of earlier parts are left out: in a crowd, most parts do.
class CoveredParts {
 public:
  CoveredParts(ImageCell& cell, ConvexPolygon whole) : cell_(&cell), whole_(std::move(whole)) {}

  /// Adds a part of the polygon. Returns false, and does not keep the part, if earlier parts
  /// certainly cover it.
  bool add(const ConvexPolygon& part);
  /// Whether the parts certainly cover the whole polygon: further parts change nothing then.
  [[nodiscard]] bool is_all() const { return is_all_; }
  /// Polygons with the same union as the parts; the polygon itself if the parts cover it.
  [[nodiscard]] const std::vector<ConvexPolygon>& parts() const { return parts_; }

 private:
  void complete();

  ImageCell* cell_;
  ConvexPolygon whole_;
  std::vector<ConvexPolygon> parts_;
  /// A superset of the uncovered rest; set once there are many parts.
  std::optional<Remainder> rest_;
  bool is_all_ = false;
};

/// The area of the union of the parts of a cell that regions cover.
class CellCoverage {
 public:
  explicit CellCoverage(ImageCell& cell) : cell_(cell), covered_(cell, cell.whole()) {}
  void add(const std::vector<LinearForm>& region);
  /// Whether the whole cell is covered: further regions change nothing then.
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
