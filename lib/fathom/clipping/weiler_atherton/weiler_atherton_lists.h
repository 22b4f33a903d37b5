#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/weiler_atherton.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Weiler–Atherton, steps 2 and 3: the lists of subject and clip, with their entering and leaving
/// contacts, and the walk along them.
namespace fathom::clipping {

/// Both sides with their contacts entered, as lists that bound one wedge of their polygon wherever
/// they pass through a point (edge_order.h).
struct NumberedSides {
  NumberedRings subject, clip;
};

/// A place in a list; see ListPlace.
struct Place {
  std::size_t point, ring;
  std::optional<ContactKind> kind;
  std::optional<std::size_t> crossing;
};

/// The places of all rings of a side, ring by ring.
struct PlaceList {
  std::vector<Place> places;
  /// Where each ring begins; at the end, where the last one ends.
  std::vector<std::size_t> rings{0};
  /// Where each crossing stands, by its number.
  std::vector<std::size_t> of_crossing;

  [[nodiscard]] std::size_t after(std::size_t place) const;
  [[nodiscard]] std::size_t before(std::size_t place) const;
};

struct PlaceLists {
  PlaceList subject, clip;
};

/// The lists. The order of edges about a point decides the kind of its contact. There each visit of
/// a ring bounds a wedge; a subject wedge and a clip wedge cross if one side of the first lies in
/// the second and the other does not: at most twice for each wedge, however many wedges meet. If a
/// subject edge and a clip edge are equal, the order is the order for a subject that lies slightly
/// further to its left, for a union to its right: then a slit between two polygons that share an
/// edge lies in neither, for a union in both. The order is the same at both ends of the edge.
/// Fails    InputError if the edges of a side do not alternate about a point; over Rational that
///          cannot happen.
PlaceLists enter_crossings(const NumberedSides& sides, const PointOrder& points,
                           SetOperation operation);

// Weiler–Atherton, step 3: the walk.

/// A place that the walk reaches, in the list that it follows from there.
struct Step {
  Border along;
  std::size_t place;
};
using Walk = std::vector<Step>;

/// The closed walks that begin at contacts, one after the other along the subject.
///
/// Intersection   from an entering contact along the subject to the next contact, which is leaving;
///                from there along the clip list to the *next* entering contact (not the contact
///                that was entered last), again along the subject, and so on until the start is
///                reached.
/// Difference     from a leaving contact along the subject to the next entering contact, and
///                backwards along the clip list to the next leaving contact.
/// Union          from a leaving contact along the subject to the next entering contact, and along
///                the clip list to the next leaving contact.
/// Together they pass every crossing once.
/// Fails    InputError if entering and leaving do not alternate along a list; over Rational that
///          cannot happen.
std::vector<Walk> walk(const PlaceLists& lists, SetOperation operation);

/// The rings that no other crosses, each as a walk, if the result lies to their left: subject rings
/// inside the clip polygon (outside, for a difference and a union), and clip rings inside the
/// subject (backwards, for a difference; outside, for a union). If both sides have the same ring,
/// the subject's counts: it is inside the clip polygon if the polygon lies on the same side of it,
/// also for a union.
std::vector<Walk> whole_rings(const PlaceLists& lists, const NumberedSides& sides,
                              const PointOrder& points, SetOperation operation);

}  // namespace fathom::clipping
