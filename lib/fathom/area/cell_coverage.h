#pragma once

#include <optional>
#include <vector>

#include "fathom/area/image_cell.h"
#include "fathom/area/remainder.h"

namespace fathom::area {

/// The area of the union of what the regions cover of a cell.
class CellCoverage {
 public:
  explicit CellCoverage(ImageCell& cell) : cell_(cell) {}
  void add(const std::vector<ImageForm>& region);
  /// Whether the whole cell is covered: what is added then changes nothing.
  [[nodiscard]] bool is_complete() const { return complete_; }
  [[nodiscard]] Ratio area();
  /// The area, rounded once.
  [[nodiscard]] float rounded_area();
  [[nodiscard]] const TierCounts& decisions() const { return counts_; }

 private:
  [[nodiscard]] Boundary boundary();
  void complete();

  ImageCell& cell_;
  std::vector<ConvexPolygon> pieces_;
  /// Of the cell, once there are many pieces.
  std::optional<Remainder> uncovered_;
  bool complete_ = false;
  TierCounts counts_;
};

}  // namespace fathom::area
