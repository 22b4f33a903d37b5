#include "fathom/clipping/weiler_atherton/edge_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

/// The numbers of the edges, in the order of `is_before`.
template <class IsBefore>
std::vector<std::size_t> in_order(std::size_t count, const IsBefore& is_before) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), is_before);
  return order;
}

}  // namespace

std::vector<SweptEdge> sweep(const std::vector<UndirectedEdge>& edges, const PointOrder& points) {
  OccasionalInterruption check;
  const auto beginning = in_order(edges.size(), [&](std::size_t a, std::size_t b) {
    check();
    const UndirectedEdge &p = edges[a], &q = edges[b];
    return p.left != q.left ? p.left < q.left : points.comes_before(p.left, p.right, q.right);
  });
  const auto ending = in_order(
      edges.size(), [&](std::size_t a, std::size_t b) { return edges[a].right < edges[b].right; });
  std::vector<SweptEdge> swept;
  swept.reserve(edges.size());
  using Line = std::set<std::size_t, IsBelow>;
  Line line(IsBelow{&edges, &points});
  std::vector<Line::const_iterator> places(edges.size());
  auto ended = ending.begin();
  for (auto begun = beginning.begin(); begun != beginning.end();) {
    check_interruption();
    const std::size_t point = edges[*begun].left;
    while (ended != ending.end() && edges[*ended].right <= point) line.erase(places[*ended++]);
    const auto above = line.lower_bound(IsBelow::Point{point});
    std::optional<std::size_t> below;
    if (above != line.begin()) below = *std::prev(above);
    for (; begun != beginning.end() && edges[*begun].left == point; ++begun) {
      swept.push_back({*begun, below});
      places[*begun] = line.emplace_hint(above, *begun);
      below = *begun;
    }
  }
  return swept;
}

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// An end of an edge at a point.
struct EdgeEnd {
  std::size_t point, other, edge;
  bool leaves;
};

/// The ends of all edges, point by point.
std::vector<EdgeEnd> ends_by_point(const std::vector<DirectedEdge>& edges) {
  std::vector<EdgeEnd> ends;
  ends.reserve(2 * edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    ends.push_back({edges[i].from, edges[i].to, i, true});
    ends.push_back({edges[i].to, edges[i].from, i, false});
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const EdgeEnd& a, const EdgeEnd& b) { return a.point < b.point; });
  return ends;
}

}  // namespace

std::vector<DirectedEdge> edges_of(const NumberedRings& rings) {
  std::vector<DirectedEdge> edges;
  for (const NumberedRing& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], following(ring, i)});
  return edges;
}

NumberedRings joined_by_wedges(const std::vector<DirectedEdge>& edges, const PointOrder& points) {
  std::vector<EdgeEnd> ends = ends_by_point(edges);
  std::vector<std::size_t> next(edges.size(), none);
  for (auto first = ends.begin(), last = first; first != ends.end(); first = last) {
    check_interruption();
    while (last != ends.end() && last->point == first->point) ++last;
    if (last - first > 2)
      std::sort(first, last, [&](const EdgeEnd& a, const EdgeEnd& b) {
        return points.comes_before(a.point, a.other, b.other);
      });
    for (auto end = first; end != last; ++end) {
      if (end->leaves) continue;
      const auto clockwise = end == first ? last - 1 : end - 1;
      if (!clockwise->leaves) refuse_what_rounding_broke();
      next[end->edge] = clockwise->edge;
    }
  }
  NumberedRings lists;
  std::vector<bool> walked(edges.size(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (walked[i]) continue;
    NumberedRing& list = lists.emplace_back();
    for (std::size_t edge = i; !walked[edge]; edge = next[edge]) {
      walked[edge] = true;
      list.push_back(edges[edge].from);
      if (next[edge] == none) refuse_what_rounding_broke();
    }
  }
  return lists;
}

NumberedRings simple_rings(const NumberedRings& closed_lists, const PointOrder& points) {
  NumberedRings rings;
  std::vector<std::size_t> place(points.size(), none);  // on the path
  for (const NumberedRing& list : closed_lists) {
    NumberedRing path;
    for (std::size_t i = 0; i < list.size(); ++i) {
      place[list[i]] = path.size();
      path.push_back(list[i]);
      const std::size_t to = following(list, i);
      if (place[to] == none) continue;
      const auto first = path.begin() + static_cast<std::ptrdiff_t>(place[to]);
      rings.emplace_back(first, path.end());
      for (auto p = first; p != path.end(); ++p) place[*p] = none;
      path.erase(first, path.end());
    }
  }
  return rings;
}

void refuse_what_rounding_broke() {
  throw InputError(
      "rounding to binary64 has broken the walk along the rings; the exact kernel does it");
}

}  // namespace fathom::clipping
