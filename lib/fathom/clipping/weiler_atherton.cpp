#include "fathom/clipping/weiler_atherton.h"

#include <utility>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/nesting.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "fathom/clipping/weiler_atherton/weiler_atherton_lists.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

template <class Number>
using Points = std::vector<Point2<Number>>;

/// Both sides by the numbers of their corners.
template <class Number>
struct NumberedInput {
  Points<Number> points;
  NumberedSides sides;
};

/// Step 1.
template <class Number>
NumberedInput<Number> with_contacts(const Rings<Number>& subject, const Rings<Number>& clip) {
  auto [all, clip_rings] = enter_contacts(Sides<Number>{subject, clip});
  all.insert(all.end(), clip_rings.begin(), clip_rings.end());
  auto [points, rings] = numbered(all);
  const auto middle = rings.begin() + static_cast<std::ptrdiff_t>(subject.size());
  return {std::move(points), {{rings.begin(), middle}, {middle, rings.end()}}};
}

const Place& place_of(const Step& step, const PlaceLists& lists) {
  return (step.along == Border::subject ? lists.subject : lists.clip).places[step.place];
}

/// The points of a walk. Steps between crossings in one point leave it where it is.
NumberedRing points_of(const Walk& walk, const PlaceLists& lists) {
  NumberedRing points;
  for (const Step& step : walk) {
    const std::size_t point = place_of(step, lists).point;
    if (points.empty() || points.back() != point) points.push_back(point);
  }
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  return points;
}

/// The closed lists of points that the walks pass. One without three points bounds nothing.
NumberedRings lists_of(const std::vector<Walk>& walks, const PlaceLists& lists) {
  NumberedRings closed;
  for (const Walk& walk : walks)
    if (NumberedRing points = points_of(walk, lists); points.size() > 2)
      closed.push_back(std::move(points));
  return closed;
}

template <class Number>
ContactList<Number> trace_of(const PlaceList& list, const Points<Number>& points) {
  ContactList<Number> result(list.rings.size() - 1);
  for (const Place& place : list.places)
    result[place.ring].push_back({points[place.point], place.kind, place.crossing});
  return result;
}

template <class Number>
std::vector<WalkStep<Number>> trace_of(const Walk& walk, const PlaceLists& lists,
                                       const Points<Number>& points) {
  std::vector<WalkStep<Number>> steps;
  for (const Step& step : walk) {
    const Place& place = place_of(step, lists);
    steps.push_back({points[place.point], step.along, place.crossing});
  }
  return steps;
}

}  // namespace

template <class Number>
std::vector<Polygon<Number>> weiler_atherton(const Rings<Number>& subject_rings,
                                             const Rings<Number>& clip_rings,
                                             SetOperation operation,
                                             WeilerAthertonTrace<Number>* trace) {
  const StandardArithmetic standard;
  const Rings<Number> subject = lists_of_side(subject_rings, "subject");
  const Rings<Number> clip = lists_of_side(clip_rings, "clip");

  const auto [points, sides] = with_contacts(subject, clip);
  const PointOrder order(points);
  const PlaceLists lists = enter_crossings(sides, order, operation);
  std::vector<Walk> walks = walk(lists, operation);
  for (Walk& whole : whole_rings(lists, sides, order, operation)) walks.push_back(std::move(whole));

  if (trace != nullptr) {
    trace->subject = trace_of(lists.subject, points);
    trace->clip = trace_of(lists.clip, points);
    for (const Walk& closed : walks) trace->walks.push_back(trace_of(closed, lists, points));
  }
  return pieces_of(lists_of(walks, lists), order, points);
}

template <class Number>
Number area_of(const std::vector<Polygon<Number>>& polygons) {
  const StandardArithmetic standard;
  std::vector<Number> areas;
  areas.reserve(polygons.size());
  for (const Polygon<Number>& polygon : polygons)
    areas.push_back(signed_area(polygon.outline) + signed_area(polygon.holes));
  return sum_of(std::move(areas));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                             \
  template std::vector<Polygon<Number>> weiler_atherton(                                       \
      const Rings<Number>&, const Rings<Number>&, SetOperation, WeilerAthertonTrace<Number>*); \
  template Number area_of(const std::vector<Polygon<Number>>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
