#include "fathom/clipping/boolean_by_cgal.h"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Filtered_kernel.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <set>
#include <utility>

#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton/nesting.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

/// Exact, by intervals where they settle it: as CGAL's own exact kernel, over our numbers.
using Kernel = CGAL::Filtered_kernel<CGAL::Simple_cartesian<CGAL::Lazy_exact_nt<Rational>>>;
using CgalRing = CGAL::Polygon_2<Kernel>;
using CgalPolygon = CGAL::Polygon_with_holes_2<Kernel>;
using CgalRegion = CGAL::Polygon_set_2<Kernel>;

CgalRing to_cgal(const Ring<Rational>& ring) {
  CgalRing result;
  for (const Point2<Rational>& p : ring) result.push_back(Kernel::Point_2(p.x, p.y));
  return result;
}

Ring<Rational> from_cgal(const CgalRing& ring) {
  Ring<Rational> result;
  for (auto p = ring.vertices_begin(); p != ring.vertices_end(); ++p)
    result.push_back({p->x().exact(), p->y().exact()});
  return result;
}

/// The ring as simple polygons of which it is the exclusive or: itself, or else the triangles of a
/// fan.
void append_simple(std::vector<CgalRing>& simple, const Ring<Rational>& ring) {
  const auto append = [&](CgalRing polygon) {
    if (polygon.orientation() == CGAL::CLOCKWISE) polygon.reverse_orientation();
    simple.push_back(std::move(polygon));
  };
  if (CgalRing whole = to_cgal(ring); ring.size() > 2 && whole.is_simple()) return append(whole);
  for (std::size_t i = 2; i < ring.size(); ++i)
    if (cross(ring[0], ring[i - 1], ring[i]) != 0) append(to_cgal({ring[0], ring[i - 1], ring[i]}));
}

CgalRegion region_of(const Rings<Rational>& rings) {
  std::vector<CgalRing> simple;
  for (const Ring<Rational>& ring : rings) append_simple(simple, ring);
  CgalRegion region;
  if (!simple.empty()) region.symmetric_difference(simple.begin(), simple.end());
  return region;
}

/// CGAL has outlines counter-clockwise and holes clockwise.
std::vector<Polygon<Rational>> pieces_of(const CgalRegion& region) {
  std::vector<CgalPolygon> polygons;
  region.polygons_with_holes(std::back_inserter(polygons));
  Rings<Rational> rings;
  for (const CgalPolygon& polygon : polygons) {
    rings.push_back(from_cgal(polygon.outer_boundary()));
    for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole)
      rings.push_back(from_cgal(*hole));
  }
  const auto [points, lists] = numbered(rings);
  return clipping::pieces_of(lists, PointOrder(points), points);
}

Rings<Rational> rings_of(const Polygon<Rational>& polygon) {
  Rings<Rational> rings{polygon.outline};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return rings;
}

/// Half-way along the first stretch inside the polygon on a level that meets no corner.
Point2<Rational> point_inside(const Polygon<Rational>& polygon) {
  const Rings<Rational> rings = rings_of(polygon);
  std::set<Rational> levels;
  for (const Ring<Rational>& ring : rings)
    for (const Point2<Rational>& p : ring) levels.insert(p.y);
  const Rational y = (*levels.begin() + *std::next(levels.begin())) / 2;
  std::vector<Rational> crossings;
  for (const Ring<Rational>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2<Rational>&a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
      if ((a.y < y) != (b.y < y))
        crossings.push_back(interpolate(a.x, b.x, Rational((y - a.y) / (b.y - a.y))));
    }
  std::sort(crossings.begin(), crossings.end());
  return {(crossings[0] + crossings[1]) / 2, y};
}

std::optional<RegionDifference> first_piece_of(const CgalRegion& region, bool in_first) {
  std::vector<Polygon<Rational>> pieces = pieces_of(region);
  if (pieces.empty()) return std::nullopt;
  const Rational area = signed_area(rings_of(pieces[0]));
  const Point2<Rational> inside = point_inside(pieces[0]);
  return RegionDifference{in_first, std::move(pieces[0]), area, inside};
}

}  // namespace

std::vector<Polygon<Rational>> boolean_by_cgal(const Rings<Rational>& subject,
                                               const Rings<Rational>& clip,
                                               SetOperation operation) {
  const StandardArithmetic standard;
  CgalRegion region = region_of(checked_rings(subject, "subject"));
  const CgalRegion other = region_of(checked_rings(clip, "clip"));
  switch (operation) {
    case SetOperation::intersection:
      region.intersection(other);
      break;
    case SetOperation::difference:
      region.difference(other);
      break;
    case SetOperation::join:
      region.join(other);
      break;
  }
  return pieces_of(region);
}

std::optional<RegionDifference> first_difference(const Rings<Rational>& first,
                                                 const Rings<Rational>& second) {
  const StandardArithmetic standard;
  const CgalRegion a = region_of(first), b = region_of(second);
  CgalRegion a_alone = a, b_alone = b;
  a_alone.difference(b);
  b_alone.difference(a);
  const auto in_first = first_piece_of(a_alone, true), in_second = first_piece_of(b_alone, false);
  if (!in_first || !in_second) return in_first ? in_first : in_second;
  return in_second->piece.outline < in_first->piece.outline ? in_second : in_first;
}

}  // namespace fathom::clipping
