#include "fathom/clipping/pieces.h"

#include <algorithm>
#include <utility>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/nesting.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/wedges.h"
#include "fathom/failures/errors.h"

namespace fathom::clipping {
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
