#pragma once

#include <array>
#include <string_view>

#include "fathom/rendering/options.h"

/// Which arithmetic settles which decision: the one place that `render --stats`, `probe` and the
/// Python module take their words from. A table in docs/architecture.md repeats them;
/// tests/rendering/deciders_test.cpp compares the two.
namespace fathom {

/// CGAL's part in the engines: intervals in binary64, rounded outwards, as a filter in front of
/// dyadic numbers.
inline constexpr std::string_view cgal_determinant = "CGAL::determinant over CGAL::Interval_nt";
inline constexpr std::string_view cgal_form = "a linear form over CGAL::Interval_nt";
inline constexpr std::string_view cgal_quotient = "a quotient over CGAL::Interval_nt";
/// Fathom's own exact numbers, m·2^e over GMP.
inline constexpr std::string_view dyadic_numbers = "dyadic numbers";

/// A kind of decision in RenderStatistics. `interval` settles the decisions that
/// TierCounts::interval counts, `exact` the rest; empty where the engine does not count this kind.
struct Deciders {
  std::string_view decision, interval, exact;
};

/// In the order of RenderStatistics: facing, edges, visibility, range, coverage, coverage_rounding,
/// rounding.
std::array<Deciders, 7> deciders_of(Engine engine);

}  // namespace fathom
