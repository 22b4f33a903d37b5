#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton.h"

/// CGAL's Boolean set operations ([CGAL], 2D Regularized Boolean Set-Operations): another
/// implementation of weiler_atherton(), and its judge. CGAL represents the region, its points and
/// its border. Fathom checks the input rings (rings.h) and brings the result into its form
/// (weiler_atherton/nesting.h), so that equal regions are equal lists.
namespace fathom::clipping {

/// Subject ∩ clip, subject − clip or subject ∪ clip, as weiler_atherton() gives them. A side is the
/// exclusive or of its rings, which is the even-odd rule.
/// Exact    nothing is rounded.
/// Fails    InputError as checked_rings()
std::vector<Polygon<Rational>> boolean_by_cgal(const Rings<Rational>& subject,
                                               const Rings<Rational>& clip, SetOperation operation);

/// A piece of the plane that one region has and another has not.
struct RegionDifference {
  bool in_first;
  Polygon<Rational> piece;
  Rational area;
  /// A point in its interior.
  Point2<Rational> inside;
};

/// The piece with the least corner that two regions differ by; nullopt if they are the same. Rings
/// are read by the even-odd rule, and may meet themselves and each other in any way.
/// Exact    nothing is rounded.
std::optional<RegionDifference> first_difference(const Rings<Rational>& first,
                                                 const Rings<Rational>& second);

}  // namespace fathom::clipping
