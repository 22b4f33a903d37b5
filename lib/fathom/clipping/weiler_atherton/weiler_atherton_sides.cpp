#include "fathom/clipping/weiler_atherton/weiler_atherton_sides.h"

#include <map>
#include <type_traits>
#include <variant>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton/sweep.h"
#include "fathom/clipping/weiler_atherton/touches.h"
#include "fathom/clipping/weiler_atherton/wedges.h"

namespace fathom::clipping {
namespace {

bool are_apart(const NumberedRings& split, const PointOrder& points) {
  std::size_t corners = 0;
  for (const NumberedRing& ring : split) corners += ring.size();
  return corners == points.size();
}

/// The edges without those that cancel each other, because they run there and back.
std::vector<DirectedEdge> border_of(const NumberedRings& rings) {
  const std::vector<DirectedEdge> all = edges_of(rings);
  std::map<UndirectedEdge, int> rising;  // how many more run from left to right
  for (const auto& [from, to] : all) rising[undirected(from, to)] += from < to ? 1 : -1;
  std::vector<DirectedEdge> border;
  for (const auto& [from, to] : all) {
    int& left = rising[undirected(from, to)];
    if ((from < to && left <= 0) || (from > to && left >= 0)) continue;
    border.push_back({from, to});
    left = 0;
  }
  return border;
}

}  // namespace

template <class Number>
Rings<Number> lists_of_side(const Rings<Number>& rings, const std::string& side) {
  Rings<Number> checked = checked_rings(rings, side);
  if (checked.size() < 2) return checked;
  const auto corners = numbered(to_exact(checked));
  const PointOrder points(corners.points);
  // Rings that were checked do not cross.
  const NumberedRings split = std::get<NumberedRings>(enter_touches(corners.rings, points));
  if (are_apart(split, points)) return checked;
  Rings<Number> lists;
  for (const NumberedRing& list : joined_by_wedges(border_of(split), points)) {
    Ring<Number>& ring = lists.emplace_back();
    for (const std::size_t corner : list) {
      const auto& [x, y] = corners.points[corner];
      if constexpr (std::is_same_v<Number, double>)
        ring.push_back({to_binary64(x), to_binary64(y)});  // a corner from before
      else
        ring.push_back({x, y});
    }
  }
  return lists;
}

template Rings<double> lists_of_side(const Rings<double>&, const std::string&);
template Rings<Rational> lists_of_side(const Rings<Rational>&, const std::string&);

}  // namespace fathom::clipping
