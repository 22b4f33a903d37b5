#pragma once

#include <type_traits>

#include "fathom/pipeline/scan/line.h"
#include "fathom/threads/interruption.h"

/// The algorithms that compute with Number, for line.cpp and for tests that count the cost of a
/// step.
namespace fathom::pipeline {

/// The signed slope: the change of the minor coordinate in one step.
template <class Number>
Number slope_of(const LineAxes& a) {
  if (a.d_major == 0) return number_of<Number>(0);
  return Number(number_of<Number>(a.minor_sign * a.d_minor) / number_of<Number>(a.d_major));
}

/// The minor coordinate nearest to y. Correct in every arithmetic, as nearest_integer().
template <class Number>
std::int64_t nearest_minor(const LineAxes& a, const Number& y) {
  const std::int64_t below = floor_of(y);
  // The difference towards 0 is not rounded.
  const bool tie = Number(y - Number(below)) * Number(2) == Number(1) &&
                   Number(Number(below + 1) - y) * Number(2) == Number(1);
  if (a.ties == TieRule::greater || !tie) return nearest_integer(y);
  const std::int64_t first = a.minor_sign > 0 ? below : below + 1;
  return a.steps_at_tie(first) ? first + a.minor_sign : first;
}

template <class Number>
void explicit_line(const LineEnds& ends, const PixelWindow& window,
                   const VisitLine<Number>& visit) {
  const LineAxes a(ends);
  const Number m = slope_of<Number>(a);
  const auto [first, last] = a.steps_in(window);
  for (std::int64_t step = first; step <= last; ++step) {
    check_interruption();
    const Number y = m * number_of<Number>(step) + number_of<Number>(a.minor0);
    const Pixel pixel = a.pixel(step, nearest_minor(a, y));
    if (window.contains(pixel)) visit(pixel, y);
  }
}

template <class Number>
void dda_line(const LineEnds& ends, const PixelWindow& window, const VisitLine<Number>& visit) {
  const LineAxes a(ends);
  const Number m = slope_of<Number>(a);
  const auto [first, last] = a.steps_in(window);
  Number y = number_of<Number>(a.minor0);
  if constexpr (std::is_same_v<Number, Exact>) {
    y += m * number_of<Number>(first);  // sums of rationals have no drift: begin where it is seen
  } else {
    for (std::int64_t step = 0; step < first; ++step) y += m;
  }
  for (std::int64_t step = first; step <= last; ++step, y += m) {
    check_interruption();
    const Pixel pixel = a.pixel(step, nearest_minor(a, y));
    if (window.contains(pixel)) visit(pixel, y);
  }
}

}  // namespace fathom::pipeline
