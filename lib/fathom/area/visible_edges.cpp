#include "fathom/area/visible_edges.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "fathom/area/plane/part_edges.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;

namespace {

/// Compares places along a line: places on it are in the same order by u, and by v if it is
/// upright. Rounded numbers decide where they differ, since rounding keeps the order.
struct EdgePlace {
  std::array<double, 2> rounded;
  const ImagePlace* exact;

  explicit EdgePlace(const ImagePlace& place)
      : rounded{round_to_binary64(place.u), round_to_binary64(place.v)}, exact(&place) {}

  friend int compare(const EdgePlace& a, const EdgePlace& b) {
    if (a.rounded[0] != b.rounded[0]) return a.rounded[0] < b.rounded[0] ? -1 : 1;
    if (const int by_u = fathom::compare(a.exact->u, b.exact->u)) return by_u;
    if (a.rounded[1] != b.rounded[1]) return a.rounded[1] < b.rounded[1] ? -1 : 1;
    return fathom::compare(a.exact->v, b.exact->v);
  }
};

struct PlacedEdge {
  EdgePlace from, to;
  VisibleEdge* edge;
};

PlacedEdge placed(VisibleEdge& edge) {
  PlacedEdge placed{EdgePlace(edge.from), EdgePlace(edge.to), &edge};
  if (compare(placed.to, placed.from) < 0) std::swap(placed.from, placed.to);
  return placed;
}

bool are_one(const PlacedEdge& a, const PlacedEdge& b) {
  const VisibleEdge &s = *a.edge, &t = *b.edge;
  return s.name == t.name && s.owner == t.owner && s.other == t.other && s.joined == t.joined &&
         compare(a.to, b.from) == 0;
}

/// Visits edges in order and joins edges that were cut at parts.
void visit_merged(std::vector<VisibleEdge> edges,
                  const std::function<void(const VisibleEdge&)>& visit) {
  std::vector<PlacedEdge> order;
  order.reserve(edges.size());
  for (VisibleEdge& edge : edges) order.push_back(placed(edge));
  std::sort(order.begin(), order.end(), [](const PlacedEdge& a, const PlacedEdge& b) {
    if (a.edge->name != b.edge->name) return a.edge->name < b.edge->name;
    return compare(a.from, b.from) < 0;
  });
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && are_one(order[end - 1], order[end])) ++end;
    const VisibleEdge& its = *order[first].edge;
    visit({its.name, *order[first].from.exact, *order[end - 1].to.exact, its.owner, its.other,
           its.joined});
    first = end;
  }
}

}  // namespace

std::string_view name_of(EdgeSelection selection) {
  constexpr std::array<std::string_view, all_edge_selections.size()> names{"silhouettes", "creases",
                                                                           "all"};
  return names[static_cast<std::size_t>(selection)];
}

void visible_edges(const TriangleSource& triangles, const Camera& camera,
                   const EdgeOptions& options, const std::function<void(const VisibleEdge&)>& visit,
                   const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  with_threads(options.threads, [&] {
    require_renderable(triangles, camera);
    constexpr std::uint64_t steps = 3;
    Progress done(progress, ProjectedScene::parts(triangles) + steps);
    const ProjectedScene scene({triangles, camera, options.cull}, done);
    std::vector<std::uint32_t> numbers(scene.count());
    std::iota(numbers.begin(), numbers.end(), 0);
    const PlaneMesh mesh(scene, numbers);
    const EdgeRule rule(triangles, mesh, options);
    PartEdges edges(mesh, rule);
    done.part_done();
    std::vector<VisibleEdge> partial = edges.partial_edges();
    done.part_done();
    edges.whole_edges(visit);
    visit_merged(std::move(partial), visit);
    done.part_done();
  });
}

}  // namespace fathom
