#include "fathom/clipping/weiler_atherton/nesting.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "fathom/failures/errors.h"

namespace fathom::clipping {
namespace {

/// A ring has an edge; it lies above or below it.
struct Bordering {
  std::size_t ring;
  bool lies_above;
};

/// Every edge once, with the rings that have it, in the order of the rings.
struct BorderedEdges {
  std::vector<UndirectedEdge> edges;
  std::vector<std::vector<Bordering>> rings;
};

BorderedEdges bordered_edges(const NumberedRings& rings, const PointOrder& points) {
  std::vector<std::pair<UndirectedEdge, Bordering>> all;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const bool counter_clockwise = direction_of(rings[r], points) > 0;
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const std::size_t from = rings[r][i], to = following(rings[r], i);
      all.push_back({undirected(from, to), {r, (from < to) == counter_clockwise}});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  BorderedEdges result;
  for (const auto& [edge, bordering] : all) {
    if (result.edges.empty() || result.edges.back() != edge) {
      result.edges.push_back(edge);
      result.rings.emplace_back();
    }
    result.rings.back().push_back(bordering);
  }
  return result;
}

/// The rings that lie above an edge of theirs, from the outermost: rings that at most touch lie in
/// each other if they lie on the same side of an edge.
std::vector<std::size_t> from_outermost(const std::vector<Bordering>& bordering,
                                        const Rings<Rational>& rings) {
  std::vector<std::size_t> above;
  for (const auto& [ring, lies_above] : bordering)
    if (lies_above) above.push_back(ring);
  if (above.size() < 2) return above;
  std::map<std::size_t, Rational> areas;
  for (const std::size_t ring : above) areas[ring] = CGAL::abs(signed_area(rings[ring]));
  std::stable_sort(above.begin(), above.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  return above;
}

[[noreturn]] void refuse_crossing(const std::string& side, std::size_t first, std::size_t second,
                                  const Point2<Rational>& point) {
  throw InputError(side + " rings " + std::to_string(first) + " and " + std::to_string(second) +
                   " cross at " + to_text(point) + "; expected rings that at most touch");
}

Point2<Rational> point_of(const EdgeCrossing& crossing,
                          const std::vector<Point2<Rational>>& points) {
  const auto segment = [&](const UndirectedEdge& edge) {
    return Segment2<Rational>{points[edge.left], points[edge.right]};
  };
  return contacts(segment(crossing.first), segment(crossing.second)).at(0);
}

}  // namespace

std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side) {
  std::vector<int> depths(rings.size(), -1);
  if (rings.size() < 2) return std::vector<int>(rings.size(), 0);
  const auto corners = numbered(rings);
  const PointOrder points(corners.points);
  const auto touching = enter_touches(corners.rings, points);
  if (const auto* crossing = std::get_if<EdgeCrossing>(&touching))
    refuse_crossing(side, crossing->first_ring, crossing->second_ring,
                    point_of(*crossing, corners.points));
  const NumberedRings& split = std::get<NumberedRings>(touching);
  if (const auto crossing = ring_crossing(split, points))
    refuse_crossing(side, crossing->first_ring, crossing->second_ring,
                    corners.points[crossing->point]);
  const BorderedEdges bordered = bordered_edges(split, points);
  std::vector<int> rings_above(bordered.edges.size());  // above each edge
  for (const auto& [edge, below] : sweep(bordered.edges, points)) {
    const int rings_below = below ? rings_above[*below] : 0;
    const std::vector<std::size_t> begun = from_outermost(bordered.rings[edge], rings);
    const auto ended = bordered.rings[edge].size() - begun.size();
    int depth = rings_below - static_cast<int>(ended);
    for (const std::size_t ring : begun) {
      // The first edge of a ring that is swept is the lower one at its least corner.
      if (depths[ring] < 0) depths[ring] = depth;
      ++depth;
    }
    rings_above[edge] = depth;
  }
  return depths;
}

std::vector<std::optional<std::size_t>> outlines_around(const NumberedRings& rings,
                                                        const PointOrder& points) {
  std::vector<std::optional<std::size_t>> outline(rings.size());
  std::vector<int> directions;
  for (const NumberedRing& ring : rings) directions.push_back(direction_of(ring, points));
  std::vector<bool> met(rings.size(), false);
  const BorderedEdges bordered = bordered_edges(rings, points);
  for (const auto& [edge, below] : sweep(bordered.edges, points)) {
    const std::size_t ring = bordered.rings[edge][0].ring;
    if (met[ring]) continue;
    met[ring] = true;
    if (directions[ring] >= 0 || !below) continue;
    // Between the hole and the edge below it lies a part of the polygon.
    const std::size_t neighbour = bordered.rings[*below][0].ring;
    outline[ring] = directions[neighbour] > 0 ? neighbour : outline[neighbour];
  }
  return outline;
}

namespace {

bool pass_a_point_twice(const NumberedRings& lists, std::size_t points) {
  std::vector<bool> passed(points, false);
  for (const NumberedRing& list : lists)
    for (const std::size_t point : list) {
      if (passed[point]) return true;
      passed[point] = true;
    }
  return false;
}

template <class Number>
std::vector<Polygon<Number>> nest(const NumberedRings& rings, const PointOrder& order,
                                  const std::vector<Point2<Number>>& points) {
  const auto outlines = outlines_around(rings, order);
  std::vector<Polygon<Number>> polygons;
  std::vector<std::size_t> polygon_of(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (direction_of(rings[r], order) > 0) {
      polygon_of[r] = polygons.size();
      polygons.push_back({ring_of(rings[r], points), {}});
    }
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (direction_of(rings[r], order) >= 0) continue;
    if (!outlines[r])
      throw InputError(
          "rounding to binary64 has left a hole without an outline; the exact kernel does it");
    polygons[polygon_of[*outlines[r]]].holes.push_back(ring_of(rings[r], points));
  }
  return polygons;
}

template <class Number>
std::vector<Polygon<Number>> in_canonical_order(std::vector<Polygon<Number>> polygons) {
  for (Polygon<Number>& polygon : polygons) {
    polygon.outline = canonical(polygon.outline);
    for (Ring<Number>& hole : polygon.holes) hole = canonical(hole);
    std::sort(polygon.holes.begin(), polygon.holes.end());
  }
  std::sort(polygons.begin(), polygons.end(),
            [](const auto& a, const auto& b) { return a.outline < b.outline; });
  return polygons;
}

}  // namespace

template <class Number>
std::vector<Polygon<Number>> pieces_of(const NumberedRings& lists, const PointOrder& order,
                                       const std::vector<Point2<Number>>& points) {
  if (!pass_a_point_twice(lists, points.size()))
    return in_canonical_order(nest(lists, order, points));
  const NumberedRings apart = joined_by_wedges(edges_of(lists), order);
  return in_canonical_order(nest(simple_rings(apart, order), order, points));
}

template std::vector<Polygon<double>> pieces_of(const NumberedRings&, const PointOrder&,
                                                const std::vector<Point2<double>>&);
template std::vector<Polygon<Rational>> pieces_of(const NumberedRings&, const PointOrder&,
                                                  const std::vector<Point2<Rational>>&);

}  // namespace fathom::clipping
