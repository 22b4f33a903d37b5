#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/weiler_atherton.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Weiler–Atherton, step 2: the lists of subject and clip, with their entering and leaving
/// contacts.
namespace fathom::clipping {

/// Both sides with their contacts entered, as lists that bound one wedge of their polygon wherever
/// they pass through a point (wedges.h).
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

/// The lists. What happens in a point follows from the order of edges about it. There each visit of
/// a ring bounds a wedge; a subject wedge and a clip wedge cross if one side of the first lies in
/// the second and the other does not: at most twice for each wedge, however many meet. Where a
/// subject edge and a clip edge are the same, the order is that of a subject that lies a little
/// further to its left, for a union to its right: then a slit between two polygons that share an
/// edge lies in neither, for a union in both. It is the same order at both ends of the edge.
/// Fails    InputError if the edges of a side do not alternate about a point; over Rational that
///          cannot happen.
PlaceLists enter_crossings(const NumberedSides& sides, const PointOrder& points,
                           SetOperation operation);

}  // namespace fathom::clipping
