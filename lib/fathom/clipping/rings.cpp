#include "fathom/clipping/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/nesting.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

[[noreturn]] void refuse(const std::string& side, std::size_t ring, const std::string& reason) {
  throw InputError(side + " ring " + std::to_string(ring) + " " + reason);
}

bool is_finite(double x) {
  return std::isfinite(x);
}
bool is_finite(const Rational&) {
  return true;
}

template <class Number>
void check_finite(const Ring<Number>& ring, const std::string& side, std::size_t number) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!is_finite(ring[i].x) || !is_finite(ring[i].y))
      refuse(side, number, "has a coordinate that is not finite, at corner " + std::to_string(i));
}

template <class Number>
Ring<Number> without_repetitions(Ring<Number> ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

void check_corners(const Ring<Rational>& ring, const std::string& side, std::size_t number) {
  Ring<Rational> corners = ring;
  OccasionalInterruption check;
  std::sort(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
    check();
    return a < b;
  });
  const auto distinct = std::unique(corners.begin(), corners.end()) - corners.begin();
  if (distinct < 3)
    refuse(side, number,
           "has " + std::to_string(distinct) +
               (distinct == 1 ? " distinct corner" : " distinct corners") +
               "; expected at least 3");
  for (const Point2<Rational>& p : ring)
    if (cross(ring[0], ring[1], p) != 0) return;
  refuse(side, number, "has no area: its corners lie on one line");
}

void check_simple(const Ring<Rational>& ring, const std::string& side, std::size_t number) {
  if (const auto meeting = self_contact(ring))
    refuse(side, number,
           "is not simple: its edges " + std::to_string(meeting->first_edge) + " and " +
               std::to_string(meeting->second_edge) + " meet at " + to_text(meeting->point));
}

}  // namespace

template <class Number>
Number sum_of(std::vector<Number> terms) {
  const StandardArithmetic standard;
  if constexpr (std::is_same_v<Number, Rational>) {
    for (; terms.size() > 1; terms.resize((terms.size() + 1) / 2))
      for (std::size_t i = 0; 2 * i < terms.size(); ++i)
        terms[i] =
            2 * i + 1 < terms.size() ? Rational(terms[2 * i] + terms[2 * i + 1]) : terms[2 * i];
    return terms.empty() ? Rational(0) : terms[0];
  } else {
    return std::accumulate(terms.begin(), terms.end(), Number(0));
  }
}

template <class Number>
Number signed_area(const Ring<Number>& ring) {
  const StandardArithmetic standard;
  check_interruption();
  std::vector<Number> terms;
  for (std::size_t i = 2; i < ring.size(); ++i)
    terms.push_back(cross(ring[0], ring[i - 1], ring[i]));
  return sum_of(std::move(terms)) / 2;
}

template <class Number>
Number signed_area(const Rings<Number>& rings) {
  const StandardArithmetic standard;
  std::vector<Number> areas;
  for (const Ring<Number>& ring : rings) areas.push_back(signed_area(ring));
  return sum_of(std::move(areas));
}

template <class Number>
Rings<Number> checked_rings(const Rings<Number>& rings, const std::string& side) {
  const StandardArithmetic standard;
  Rings<Number> checked;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    check_finite(rings[i], side, i);
    checked.push_back(without_repetitions(rings[i]));
  }
  const Rings<Rational> exact = to_exact(checked);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    check_corners(exact[i], side, i);
    check_simple(exact[i], side, i);
  }
  const std::vector<int> depths = nesting_depths(exact, side);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const bool is_hole = depths[i] % 2 != 0;
    if ((signed_area(exact[i]) < 0) != is_hole) std::reverse(checked[i].begin(), checked[i].end());
  }
  return checked;
}

template <class Number>
void check_convex(const Ring<Number>& ring, const std::string& side) {
  const StandardArithmetic standard;
  const Ring<Rational> exact = to_exact(Rings<Number>{ring})[0];
  const std::size_t n = exact.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(exact[i], exact[(i + 1) % n], exact[(i + 2) % n]) < 0)
      throw InputError(side + " is not convex at " + to_text(exact[(i + 1) % n]) +
                       "; expected a convex polygon (weiler-atherton takes any)");
}

template <class Number>
Ring<Number> canonical(const Ring<Number>& ring) {
  Ring<Number> corners;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]) != 0) corners.push_back(ring[i]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                                                \
  template Number sum_of(std::vector<Number>);                                    \
  template Number signed_area(const Ring<Number>&);                               \
  template Number signed_area(const Rings<Number>&);                              \
  template Rings<Number> checked_rings(const Rings<Number>&, const std::string&); \
  template void check_convex(const Ring<Number>&, const std::string&);            \
  template Ring<Number> canonical(const Ring<Number>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
