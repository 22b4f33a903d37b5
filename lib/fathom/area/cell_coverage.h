#pragma once

#include <vector>

#include "fathom/area/covered_parts.h"
#include "fathom/area/image_cell.h"

namespace fathom::area {

/// The area of the union of what the regions cover of a cell.
class CellCoverage {
 public:
  explicit CellCoverage(ImageCell& cell) : cell_(cell), covered_(cell, cell.whole()) {}
  void add(const std::vector<ImageForm>& region);
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
