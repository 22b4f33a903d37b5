#include "tests/clipping/cgal_judge.h"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>
#include <vector>

namespace fathom::clipping::test {
namespace {

using Kernel = CGAL::Simple_cartesian<Rational>;
using CgalPolygon = CGAL::Polygon_2<Kernel>;
using CgalHoled = CGAL::Polygon_with_holes_2<Kernel>;
using CgalSet = CGAL::Polygon_set_2<Kernel>;

CgalPolygon polygon_of(const Ring<Rational>& ring) {
  CgalPolygon polygon;
  for (const Point2<Rational>& p : ring) polygon.push_back({p.x, p.y});
  return polygon;
}

CgalSet set_of(const Rings<Rational>& rings) {
  CgalSet set;
  for (const Ring<Rational>& ring : rings) {
    CgalPolygon polygon = polygon_of(ring);
    if (!polygon.is_simple()) throw std::logic_error("a test polygon that is not simple");
    if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
    set.symmetric_difference(polygon);
  }
  return set;
}

Rational area_of(const CgalPolygon& polygon) {
  return polygon.area();
}

Rational area_of(const CgalSet& set) {
  std::vector<CgalHoled> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  Rational area(0);
  for (const CgalHoled& part : parts) {
    area += area_of(part.outer_boundary());
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) area += area_of(*hole);
  }
  return area;
}

std::optional<std::string> ring_fault(const Ring<Rational>& ring, bool is_hole) {
  const CgalPolygon polygon = polygon_of(ring);
  if (ring.size() < 3 || !polygon.is_simple()) return "a ring that is not simple";
  if (polygon.is_clockwise_oriented() != is_hole) return "a ring that runs the wrong way";
  return std::nullopt;
}

}  // namespace

struct Judge::Regions {
  CgalSet intersection, difference, join;
  [[nodiscard]] const CgalSet& of(SetOperation operation) const {
    if (operation == SetOperation::join) return join;
    return operation == SetOperation::intersection ? intersection : difference;
  }
};

Judge::Judge(const Rings<Rational>& subject, const Rings<Rational>& clip)
    : regions_(std::make_unique<Regions>()) {
  const CgalSet a = set_of(subject), b = set_of(clip);
  regions_->intersection.intersection(a, b);
  regions_->difference.difference(a, b);
  regions_->join.join(a, b);
}

Judge::~Judge() = default;

Rational Judge::area(SetOperation operation) const {
  return area_of(regions_->of(operation));
}

std::optional<std::string> Judge::fault(SetOperation operation,
                                        const std::vector<Polygon<Rational>>& answer) const {
  CgalSet ours;
  Rational sum(0);
  for (const Polygon<Rational>& polygon : answer) {
    if (const auto fault = ring_fault(polygon.outline, false)) return fault;
    CgalPolygon outline = polygon_of(polygon.outline);
    sum += area_of(outline);
    CgalSet part(outline);
    for (const Ring<Rational>& ring : polygon.holes) {
      if (const auto fault = ring_fault(ring, true)) return fault;
      CgalPolygon hole = polygon_of(ring);
      sum += area_of(hole);
      hole.reverse_orientation();
      part.difference(hole);
    }
    ours.join(part);
  }
  // Each hole in its outline and all parts disjoint: then no area is lost by − and ∪.
  if (area_of(ours) != sum) return "parts that overlap or holes outside their outlines";
  ours.symmetric_difference(regions_->of(operation));
  if (!ours.is_empty()) return "another point set than CGAL's";
  return std::nullopt;
}

}  // namespace fathom::clipping::test
