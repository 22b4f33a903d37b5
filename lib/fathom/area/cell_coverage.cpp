#include "fathom/area/cell_coverage.h"

#include "fathom/area/image_cell.h"
#include "fathom/numeric/rounding.h"

namespace fathom::area {

bool Remainder::meets(const ConvexPolygon& polygon) const {
  TierCounts counts;
  for (const ConvexPolygon& part : parts_) {
    ConvexPolygon common = part;
    if (cell_->all().clip(common, polygon, counts)) return true;
  }
  return false;
}

// A point outside a polygon is outside its first edge, or inside the first and outside the second
// edge, and so on. No point is outside a side of the cell.
void Remainder::subtract(const ConvexPolygon& polygon, std::size_t most) {
  struct Edge {
    const HalfPlane *inside, *outside;
  };
  std::vector<Edge> edges;
  for (const HalfPlane* edge : polygon.edges()) {
    if (!cell_->is_side(edge)) edges.push_back({edge, &cell_->opposite(*edge)});
  }
  TierCounts counts;
  std::vector<ConvexPolygon> left;
  for (const ConvexPolygon& part : parts_) {
    std::vector<ConvexPolygon> outside;
    ConvexPolygon rest = part;
    bool is_met = part.bounds().may_meet(polygon.bounds());
    for (const Edge& edge : edges) {
      if (!is_met) break;
      ConvexPolygon beyond = rest;
      if (beyond.clip(*edge.outside, counts)) outside.push_back(std::move(beyond));
      is_met = rest.clip(*edge.inside, counts);
    }
    // A part that the polygon does not meet remains whole.
    if (!is_met) outside.assign(1, part);
    for (ConvexPolygon& piece : outside) left.push_back(std::move(piece));
    if (left.size() > most) return;
  }
  parts_ = std::move(left);
}

void CoveredParts::complete() {
  is_all_ = true;
  parts_.assign(1, whole_);
}

bool CoveredParts::add(const ConvexPolygon& part) {
  if (is_all_) return false;
  if (part.edges() == whole_.edges()) {
    complete();
    return true;
  }
  if (rest_ && !rest_->meets(part)) return false;
  parts_.push_back(part);
  if (parts_.size() <= DivisionLimits{}.few) return true;
  if (rest_) {
    rest_->subtract(part, Remainder::simple);
  } else {
    rest_.emplace(*cell_, whole_);
    for (const ConvexPolygon& each : parts_) rest_->subtract(each, Remainder::simple);
  }
  if (rest_->is_empty()) complete();
  return true;
}

void CellCoverage::add(const std::vector<LinearForm>& region) {
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
