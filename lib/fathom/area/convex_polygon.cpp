#include "fathom/area/convex_polygon.h"

#include <algorithm>

#include "fathom/numeric/divisors.h"

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

namespace {

std::size_t hash_of(const HalfPlane& h) {
  std::size_t hash = 0;
  for (const Dyadic& x : h.exact()) hash = hash * 31 + fathom::hash_of(x);
  return hash;
}

}  // namespace

const HalfPlane& MergedLines::find(const ExactVector3& coefficients) {
  HalfPlane line(without_common_factor(coefficients));
  const std::size_t hash = hash_of(line);
  const auto [first, end] = by_hash_.equal_range(hash);
  for (auto candidate = first; candidate != end; ++candidate) {
    if (candidate->second->exact() == line.exact()) return *candidate->second;
  }
  const HalfPlane& kept = lines_.emplace_back(std::move(line));
  by_hash_.emplace(hash, &kept);
  known_.emplace(&kept, &kept);
  return kept;
}

const HalfPlane& MergedLines::of(const HalfPlane& h) {
  if (const auto known = known_.find(&h); known != known_.end()) return *known->second;
  const HalfPlane& line = find(h.exact());
  known_.emplace(&h, &line);
  return line;
}

const HalfPlane& MergedLines::opposite(const HalfPlane& h) {
  const HalfPlane& line = of(h);
  if (const auto known = opposites_.find(&line); known != opposites_.end()) return *known->second;
  const ExactVector3& l = line.exact();
  const HalfPlane& other = find({-l[0], -l[1], -l[2]});
  opposites_.emplace(&line, &other);
  opposites_.emplace(&other, &line);
  return other;
}

ConvexPolygon MergedLines::of(const ConvexPolygon& polygon) {
  std::vector<const HalfPlane*> edges;
  edges.reserve(polygon.edges().size());
  for (const HalfPlane* edge : polygon.edges()) edges.push_back(&of(*edge));
  return ConvexPolygon(std::move(edges));
}

}  // namespace fathom::area
