#include "fathom/area/convex_polygon.h"

#include <algorithm>

namespace fathom::area {
namespace {

/// x_i·y_j − x_j·y_i
Certified<double> minor(const HalfPlane& x, const HalfPlane& y, std::size_t i, std::size_t j) {
  Certified<double> q = approximate_coefficient(x, j) * approximate_coefficient(y, i);
  q.value = -q.value;
  return approximate_coefficient(x, i) * approximate_coefficient(y, j) + q;
}

void widen(Interval& range, const Certified<double>& x) {
  const Interval around = enclose(x);
  range.lower = std::min(range.lower, around.lower);
  range.upper = std::max(range.upper, around.upper);
}

}  // namespace

CertifiedPoint approximate_crossing(const HalfPlane& a, const HalfPlane& b) {
  const Certified<double> weight = approximate_turn(a, b);
  return {minor(a, b, 1, 2) / weight, minor(a, b, 2, 0) / weight};
}

void ConvexPolygon::find_bounds() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bounds_.u = bounds_.v = {infinity, -infinity};
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const CertifiedPoint vertex = approximate_crossing(*edges_[k], after(k));
    widen(bounds_.u, vertex.u);
    widen(bounds_.v, vertex.v);
  }
}

// Vertex k lies between the edges k and k + 1, whose turn is positive: there h has the sign of
// det(h, edge k, edge k + 1). An edge stays if one of its ends is inside; h becomes the edge after
// the one that leaves.
bool ConvexPolygon::clip(const HalfPlane& h, TierCounts& counts) {
  const std::size_t n = edges_.size();
  std::vector<Sign> side(n);
  for (std::size_t k = 0; k < n; ++k)
    side[k] = sign_of_determinant(h, *edges_[k], after(k), counts);
  if (std::find(side.begin(), side.end(), Sign::positive) == side.end()) return false;
  if (std::find(side.begin(), side.end(), Sign::negative) == side.end()) return true;
  std::vector<const HalfPlane*> kept;
  kept.reserve(n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const bool starts_inside = side[(k + n - 1) % n] == Sign::positive;
    const bool ends_inside = side[k] == Sign::positive;
    if (starts_inside || ends_inside) kept.push_back(edges_[k]);
    if (starts_inside && !ends_inside) kept.push_back(&h);
  }
  edges_ = std::move(kept);
  find_bounds();
  return true;
}

}  // namespace fathom::area
