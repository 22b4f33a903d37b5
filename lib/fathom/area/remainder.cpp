#include "fathom/area/remainder.h"

namespace fathom::area {

bool Remainder::meets(const ConvexPolygon& polygon) const {
  TierCounts counts;
  for (const ConvexPolygon& part : parts_) {
    ConvexPolygon common = part;
    if (cell_->all().clip(common, polygon, counts)) return true;
  }
  return false;
}

// What lies outside a polygon lies outside its first edge, or inside that and outside the second,
// and so on. Nothing lies outside a side of the cell.
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
    // Where nothing is met, the part stays in one piece.
    if (!is_met) outside.assign(1, part);
    for (ConvexPolygon& piece : outside) left.push_back(std::move(piece));
    if (left.size() > most) return;
  }
  parts_ = std::move(left);
}

}  // namespace fathom::area
