#pragma once

#include <optional>
#include <string>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"

/// Where edges meet: the first step of Weiler–Atherton.
namespace fathom::clipping {

/// The points that two segments of positive length have in common, as far as rings need to know
/// them: the point of a proper crossing, and every end of a segment that lies on the other. A
/// collinear overlap gives its two ends, so that after splitting there, edges are equal or meet
/// only in ends.
/// Fails    InputError over double, if the deciding products are beyond binary64
template <class Number>
std::vector<Point2<Number>> contacts(const Segment2<Number>& a, const Segment2<Number>& b);

/// More points of contact are refused: each is a corner of the result, and n edges can meet in
/// n²/4.
inline constexpr std::size_t most_contacts = std::size_t{1} << 18;

/// Two sides, whose rings may pass through points again.
template <class Number>
struct Sides {
  Rings<Number> subject, clip;
};

/// The rings, with every contact between a subject ring and a clip ring entered in both as a
/// corner.
/// Cost     n log n, and the pairs of edges whose boxes meet
/// Fails    InputError where there are more than `most_contacts`
/// Exact    over Rational. Over double a crossing is rounded, to the same point in both rings.
template <class Number>
Sides<Number> enter_contacts(const Sides<Number>& sides);

/// Two edges of one ring, numbered by their first corners, that meet other than as neighbours do.
struct SelfContact {
  std::size_t first_edge, second_edge;
  Point2<Rational> point;
};
/// The first pair from the left, found by a sweep; nullopt if there is none.
std::optional<SelfContact> self_contact(const Ring<Rational>& ring);

/// "(1/3, 2)", with long fractions to 17 digits: for messages.
std::string to_text(const Point2<Rational>& point);

}  // namespace fathom::clipping
