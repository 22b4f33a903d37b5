#include "fathom/area/cell_coverage.h"

#include "fathom/area/cell_division.h"
#include "fathom/numeric/rounding.h"

namespace fathom::area {

void CellCoverage::add(const std::vector<ImageForm>& region) {
  if (is_complete()) return;
  if (const auto piece = cell_.clip(region, counts_)) covered_.add(piece->polygon);
}

Boundary CellCoverage::boundary() {
  Boundary boundary;
  for_each_simple_part(cell_, covered_.parts(), counts_,
                       [&](std::span<const ConvexPolygon> pieces) {
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
