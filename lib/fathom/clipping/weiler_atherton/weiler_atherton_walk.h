#pragma once

#include <vector>

#include "fathom/clipping/weiler_atherton/weiler_atherton_lists.h"

/// Weiler–Atherton, step 3: the walk.
namespace fathom::clipping {

/// A place that the walk comes to, in the list that it follows from there.
struct Step {
  Border along;
  std::size_t place;
};
using Walk = std::vector<Step>;

/// The closed walks that begin at contacts, one after the other along the subject.
///
/// Intersection   from an entering contact along the subject to the next one, which is leaving;
///                from there along the clip list to the *next* entering contact (not the one that
///                was entered last), again along the subject, and so on until the start is reached.
/// Difference     from a leaving contact along the subject to the next entering one, and backwards
///                along the clip list to the next leaving one.
/// Union          from a leaving contact along the subject to the next entering one, and along the
///                clip list to the next leaving one.
/// Together they pass every crossing once.
/// Fails    InputError if entering and leaving do not alternate along a list; over Rational that
///          cannot happen.
std::vector<Walk> walk(const PlaceLists& lists, SetOperation operation);

/// The rings that no other crosses, each as a walk, if the result lies to their left: subject rings
/// inside the clip polygon (outside, for a difference and a union), and clip rings inside the
/// subject (backwards, for a difference; outside, for a union). Of a ring that both sides have, the
/// subject's counts: it is inside the clip polygon where that lies on the same side of it, and in a
/// union too.
std::vector<Walk> whole_rings(const PlaceLists& lists, const NumberedSides& sides,
                              const PointOrder& points, SetOperation operation);

}  // namespace fathom::clipping
