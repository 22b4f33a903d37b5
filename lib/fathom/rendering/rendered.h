#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/numeric/certified.h"
#include "fathom/rendering/options.h"

namespace fathom {

/// Counts of decisions by arithmetic. The fast engine makes fewer decisions: it does not count
/// triangles that reach behind the camera and miss the image as degenerate or culled, and counts a
/// sample as covered only if the triangle is not behind an already drawn triangle.
struct RenderStatistics {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate_triangles = 0;  // Δ = 0, seen edge on
  std::uint64_t culled_triangles = 0;
  std::uint64_t samples_tested = 0;
  std::uint64_t samples_covered = 0;
  std::uint64_t pixels_with_surface = 0;
  TierCounts facing, edges, visibility, range;
  /// Signs for channel A.
  TierCounts coverage;

  // Only in the fast engine:
  /// Pixels whose coverage is not evidently 0 or 1: settled by a bound, and by exact numbers.
  TierCounts coverage_rounding;
  /// Values rounded from an interval, and values written from exact numbers.
  TierCounts rounding;
  /// Part of rounding.interval: settled by double-words, not by binary64.
  std::uint64_t double_word_roundings = 0;
  /// Areas that needed the ends of edges from exact numbers; coverage_rounding counts them, too.
  std::uint64_t areas_with_exact_ends = 0;
  /// Samples that binary32 did not settle: settled by binary64, or counted as exact.
  std::uint64_t samples_in_binary64 = 0;
  /// How often a triangle was set up from exact numbers or double-words: once for each tile that it
  /// meets, and once to find them.
  std::uint64_t exact_setups = 0;
  /// Part of visibility.exact: settled because both triangles lie in one plane.
  std::uint64_t same_plane = 0;
  /// Part of edges.exact, visibility.exact and range.exact: settled by double-words.
  std::uint64_t double_words = 0;
  /// How often, once for each tile, a triangle was set up with corners exactly on the grid on which
  /// edge functions have no error.
  std::uint64_t grid_setups = 0;
};

/// Calls visit(name, &RenderStatistics::member) for each count: whole numbers first, then counts of
/// decisions.
template <class Visit>
constexpr void for_each_count(const Visit& visit) {
  using S = RenderStatistics;
  visit("triangles", &S::triangles);
  visit("degenerate_triangles", &S::degenerate_triangles);
  visit("culled_triangles", &S::culled_triangles);
  visit("samples_tested", &S::samples_tested);
  visit("samples_covered", &S::samples_covered);
  visit("pixels_with_surface", &S::pixels_with_surface);
  visit("exact_setups", &S::exact_setups);
  visit("same_plane", &S::same_plane);
  visit("double_words", &S::double_words);
  visit("samples_in_binary64", &S::samples_in_binary64);
  visit("grid_setups", &S::grid_setups);
  visit("double_word_roundings", &S::double_word_roundings);
  visit("areas_with_exact_ends", &S::areas_with_exact_ends);
  visit("facing", &S::facing);
  visit("edges", &S::edges);
  visit("visibility", &S::visibility);
  visit("range", &S::range);
  visit("coverage", &S::coverage);
  visit("coverage_rounding", &S::coverage_rounding);
  visit("rounding", &S::rounding);
}

/// Calls visit(number) for each number of the counts, which it may change.
template <class Visit>
constexpr void for_each_number(RenderStatistics& statistics, const Visit& visit) {
  for_each_count([&](const char*, auto member) {
    auto& count = statistics.*member;
    if constexpr (std::is_same_v<decltype(count), TierCounts&>) {
      visit(count.interval);
      visit(count.exact);
    } else {
      visit(count);
    }
  });
}

/// Adds the counts of a part of the work.
void add(RenderStatistics& sum, const RenderStatistics& part);

/// The result of a render.
struct Rendered {
  DepthMap map;
  RenderStatistics statistics;
  /// If FastSwitches::find_doubtful is set: the pixels (row · width + column) at which a bound of
  /// the fast engine did not settle a decision about an edge, the range, visibility, or the
  /// rounding of Z or of A; some of them twice.
  std::vector<std::uint64_t> doubtful;
};

// Which arithmetic settles which decision: the only source of the words in `render --stats`,
// `probe` and the Python module. A table in docs/architecture.md repeats them;
// tests/rendering/deciders_test.cpp compares the two.

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
