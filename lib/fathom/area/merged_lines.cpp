#include "fathom/area/merged_lines.h"

#include "fathom/numeric/common_factor.h"

namespace fathom::area {
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
