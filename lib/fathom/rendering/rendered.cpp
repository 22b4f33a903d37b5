#include "fathom/rendering/rendered.h"

namespace fathom {
namespace {

constexpr std::size_t count_numbers() {
  RenderStatistics statistics;
  std::size_t count = 0;
  for_each_number(statistics, [&](std::uint64_t&) { ++count; });
  return count;
}

static_assert(count_numbers() * sizeof(std::uint64_t) == sizeof(RenderStatistics),
              "for_each_count() visits all");

}  // namespace

void add(RenderStatistics& sum, const RenderStatistics& part) {
  for_each_count([&](const char*, auto count) { sum.*count += part.*count; });
}

namespace {

constexpr std::string_view own_bounds = "Fathom's bounds";
constexpr std::string_view words_then_dyadic =
    "double-words with Fathom's bounds, then dyadic numbers";

// Where each stands: triangle/projected_triangle.cpp (facing, edges), reference/reference.cpp
// (visibility, range), area/convex_polygon.cpp (coverage).
constexpr std::array<Deciders, 7> reference_deciders{{
    {"facing", cgal_determinant, dyadic_numbers},
    {"edges", cgal_form, dyadic_numbers},
    {"visibility", cgal_quotient, dyadic_numbers},
    {"range", cgal_form, dyadic_numbers},
    {"coverage", own_bounds, dyadic_numbers},
    {"coverage_rounding", "", ""},
    {"rounding", "", ""},
}};

// fast/, and triangle/referee.cpp for decisions that bounds in binary64 do not settle.
constexpr std::array<Deciders, 7> fast_deciders{{
    {"facing", own_bounds, "CGAL::determinant over CGAL::Interval_nt, then dyadic numbers"},
    {"edges", own_bounds,
     "double-words with Fathom's bounds, then a linear form over CGAL::Interval_nt, then dyadic "
     "numbers"},
    {"visibility", own_bounds, words_then_dyadic},
    {"range", own_bounds, words_then_dyadic},
    {"coverage", "", ""},
    {"coverage_rounding", own_bounds, dyadic_numbers},
    {"rounding", own_bounds, dyadic_numbers},
}};

}  // namespace

std::array<Deciders, 7> deciders_of(Engine engine) {
  return engine == Engine::reference ? reference_deciders : fast_deciders;
}

}  // namespace fathom
