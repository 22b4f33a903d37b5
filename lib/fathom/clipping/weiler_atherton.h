#pragma once

#include <vector>

#include "fathom/clipping/points.h"

/// Clipping of any polygon by any other: concave, with holes, into several pieces.
/// Source   [WA77], [Wei80]; [FHP19] for degenerate contacts.
///
/// The four steps, each in a file of its own:
///   1  contacts          every point in which a subject ring meets a clip ring is entered in both
///                        lists; edges that overlap become one and the same edge   (contacts.h)
///   2  labels            every edge is inside, outside or along the other polygon, so a contact is
///                        entering, leaving or touching   (weiler_atherton_labels.h)
///   3  walk              along the subject while it is inside, at a leaving contact onto the clip
///                        polygon, to the next entering contact and back onto the subject, until
///                        the start is reached   (weiler_atherton_walk.h)
///   4  holes             each clockwise ring goes to the outline that contains it
/// Nothing is perturbed. Labelling edges instead of points is what decides every degenerate
/// contact: a shared vertex, a vertex on an edge, overlapping edges, identical polygons.
namespace fathom::clipping {

enum class SetOperation { intersection, difference };

/// An outline, counter-clockwise, and its holes, clockwise. Each ring is simple; rings touch at
/// most in points, and the interior is connected.
template <class Number>
struct Polygon {
  Ring<Number> outline;
  Rings<Number> holes;
};

/// Where an edge of a subject ring lies with respect to the clip polygon.
enum class Relation { inside, outside, along };

enum class ContactKind {
  /// The subject enters the clip polygon here, or along the shared piece that ends here.
  entering,
  leaving,
  /// It is on the same side before and after.
  touching,
  /// A shared piece begins or continues.
  along,
};

/// A point of a subject ring that lies on the border of the clip polygon.
template <class Number>
struct Contact {
  std::size_t ring;
  Point2<Number> point;
  Relation before, after;
  ContactKind kind;
};

/// Whose border the walk follows from a point.
enum class Border { subject, clip, both };

template <class Number>
struct WalkStep {
  Point2<Number> from;
  Border along;
};

template <class Number>
struct WeilerAthertonTrace {
  std::vector<Contact<Number>> contacts;
  /// One for each closed walk; a walk that meets itself in a point yields more than one ring.
  std::vector<std::vector<WalkStep<Number>>> walks;
};

/// Subject ∩ clip or subject − clip, as regions: parts of lower dimension are dropped. Polygons and
/// holes are in the order of their least corners; rings start there and have no straight corners,
/// so the same region always gives the same list.
///
/// Exact    over Rational. Over double crossings are rounded, and the region is approximate.
/// Fails    InputError, as checked_rings() does; over double also if rounding has broken the
///          topology, so that a walk does not close.
template <class Number>
std::vector<Polygon<Number>> weiler_atherton(const Rings<Number>& subject,
                                             const Rings<Number>& clip, SetOperation operation,
                                             WeilerAthertonTrace<Number>* trace = nullptr);

/// The sum of the polygons' areas.
template <class Number>
Number area_of(const std::vector<Polygon<Number>>& polygons);

}  // namespace fathom::clipping
