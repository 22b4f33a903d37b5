#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/points.h"

/// Clipping of any polygon by any other: concave, with holes, into several pieces.
/// Source   [WA77], [Wei80]; [FHP19] for degenerate contacts.
///
/// The four steps, each in a file of its own:
///   1  contacts   every point in which a subject ring meets a clip ring is entered in both lists
///                 (contacts.h)
///   2  lists      where the rings cross, the contact is *entering* or *leaving*, as the subject
///                 enters the clip polygon or leaves it; else they touch
///                 (weiler_atherton_lists.h)
///   3  walk       from an entering contact along the subject to the next contact, which is
///                 leaving; there over to the clip list, along it to the next entering contact and
///                 back to the subject, until the start is reached (weiler_atherton_lists.h). Rings
///                 without a crossing belong to the result or do not, as a whole
///   4  pieces     each clockwise ring goes to the outline around it (weiler_atherton/nesting.h)
///
/// Degenerate contacts need two more steps. Before step 1, rings of one side that touch each other
/// become lists that bound a single wedge of their polygon wherever they pass through a point, and
/// edges that two rings share are dropped (weiler_atherton/side_contacts.h). After step 3, walks
/// that pass through a point again become such lists too (weiler_atherton/nesting.h). Nothing is
/// moved: where edges of subject and clip run along each other, the *order* of edges about a point
/// is the order for a subject that lies slightly further inside itself (for a union, outside
/// itself). This order alone decides shared vertices, vertices on edges, overlapping edges and
/// identical polygons.
namespace fathom::clipping {

/// `join` is the union; `union` is a keyword of C++.
enum class SetOperation { intersection, difference, join };

/// An outline, counter-clockwise, and its holes, clockwise. Each ring is simple; rings touch at
/// most in points, and the interior is connected.
template <class Number>
struct Polygon {
  Ring<Number> outline;
  Rings<Number> holes;
};

enum class ContactKind {
  /// The subject enters the clip polygon here: the clip ring leaves the subject.
  entering,
  leaving,
  /// Both rings pass through the point, and do not cross.
  touching,
  /// The same, and both have the edge that follows.
  along,
};

/// A place in a list: a corner of a ring, a contact, or both. A ring that crosses several others in
/// a single point has a place there for each crossing, in the order of the crossings.
template <class Number>
struct ListPlace {
  Point2<Number> point;
  /// nullopt for a corner that is not a contact.
  std::optional<ContactKind> kind;
  /// The number of the crossing, which is the same in both lists, counted along the subject.
  std::optional<std::size_t> crossing;
};

/// The places of each ring of a side, in order. The polygon lies to the left.
template <class Number>
using ContactList = std::vector<std::vector<ListPlace<Number>>>;

/// Whose list the walk follows.
enum class Border { subject, clip };

template <class Number>
struct WalkStep {
  Point2<Number> from;
  Border along;
  /// The crossing at which the walk turns to this list.
  std::optional<std::size_t> crossing;
};

template <class Number>
struct WeilerAthertonTrace {
  ContactList<Number> subject, clip;
  /// One for each closed walk. A walk may have several steps from a point where several rings
  /// cross; a walk without any other point bounds no area.
  std::vector<std::vector<WalkStep<Number>>> walks;
};

/// Subject ∩ clip, subject − clip or subject ∪ clip, as regions: parts of lower dimension are
/// dropped. Polygons and holes are in the order of their least corners; rings start there and have
/// no straight corners, so the same region always gives the same list.
///
/// Cost     n log n, the pairs of a subject edge and a clip edge whose boxes meet, and the pairs of
///          rings of one side that share an edge
/// Exact    over Rational. Over double crossings are rounded, and the region is approximate; the
///          order of edges about the rounded points is exact.
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
