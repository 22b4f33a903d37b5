#include "fathom/area/covered_parts.h"

#include "fathom/area/cell_division.h"

namespace fathom::area {

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

}  // namespace fathom::area
