#include "fathom/area/remainder.h"

#include "fathom/area/cell_division.h"

namespace fathom::area {

bool Remainder::meets(const ConvexPolygon& polygon) const {
  TierCounts counts;
  for (const ConvexPolygon& part : parts_) {
    if (!part.bounds().may_meet(polygon.bounds())) continue;
    ConvexPolygon common = part;
    bool has_area = true;
    for (const HalfPlane* edge : polygon.edges()) {
      has_area = has_area && common.clip(*edge, counts);
    }
    if (has_area) return true;
  }
  return false;
}

// What lies outside a polygon lies outside its first edge, or inside that and outside the second,
// and so on.
void Remainder::subtract(const ConvexPolygon& polygon, std::size_t most) {
  TierCounts counts;
  std::vector<ConvexPolygon> left;
  for (const ConvexPolygon& part : parts_) {
    std::vector<ConvexPolygon> outside;
    ConvexPolygon rest = part;
    bool is_met = part.bounds().may_meet(polygon.bounds());
    for (const HalfPlane* edge : polygon.edges()) {
      if (!is_met) break;
      ConvexPolygon beyond = rest;
      if (beyond.clip(cell_->opposite(*edge), counts)) outside.push_back(std::move(beyond));
      is_met = rest.clip(*edge, counts);
    }
    // Where nothing is met, the part stays in one piece.
    if (!is_met) outside.assign(1, part);
    for (ConvexPolygon& piece : outside) left.push_back(std::move(piece));
    if (left.size() > most) return;
  }
  parts_ = std::move(left);
}

bool PartlyHidden::hide(const ConvexPolygon& part) {
  if (part.edges() == polygon_.edges()) is_hidden_ = true;
  if (is_hidden_) return true;
  if (!rest_) {
    parts_.push_back(part);
    if (parts_.size() <= DivisionLimits{}.few) return true;
    rest_.emplace(*cell_, polygon_);
    for (const ConvexPolygon& hidden : parts_) rest_->subtract(hidden, Remainder::simple);
  } else {
    if (!rest_->meets(part)) return false;
    rest_->subtract(part, Remainder::simple);
  }
  is_hidden_ = rest_->is_empty();
  return true;
}

}  // namespace fathom::area
