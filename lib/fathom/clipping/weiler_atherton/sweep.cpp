#include "fathom/clipping/weiler_atherton/sweep.h"

#include <algorithm>
#include <numeric>
#include <set>

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

}  // namespace fathom::clipping
