#include "fathom/area/cell_coverage.h"

#include "fathom/area/cell_division.h"
#include "fathom/numeric/rounding.h"

namespace fathom::area {

void CellCoverage::complete() {
  complete_ = true;
  pieces_.assign(1, cell_.whole());
}

void CellCoverage::add(const std::vector<ImageForm>& region) {
  if (complete_) return;
  auto piece = cell_.clip(region, counts_);
  if (!piece) return;
  if (piece->is_whole) {
    complete();
    return;
  }
  // In a crowd, most pieces lie within the union of those before.
  if (uncovered_ && !uncovered_->meets(piece->polygon)) return;
  pieces_.push_back(std::move(piece->polygon));
  if (pieces_.size() <= DivisionLimits{}.few) return;
  if (!uncovered_) {
    uncovered_.emplace(cell_, cell_.whole());
    for (const ConvexPolygon& polygon : pieces_) {
      uncovered_->subtract(polygon, Remainder::simple);
    }
  } else {
    uncovered_->subtract(pieces_.back(), Remainder::simple);
  }
  if (uncovered_->is_empty()) complete();
}

Boundary CellCoverage::boundary() {
  Boundary boundary;
  for_each_simple_part(cell_, pieces_, counts_, [&](std::span<const ConvexPolygon> pieces) {
    const Boundary more = boundary_of_union(pieces, counts_);
    boundary.insert(boundary.end(), more.begin(), more.end());
  });
  return boundary;
}

Ratio CellCoverage::area() {
  return exact_area(boundary());
}

float CellCoverage::rounded_area() {
  const Boundary found = boundary();
  if (const auto settled = settled_binary32(approximate_area(found))) return *settled;
  return round_to_binary32(exact_area(found));
}

}  // namespace fathom::area
