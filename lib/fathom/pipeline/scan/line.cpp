#include "fathom/pipeline/scan/line.h"

#include <algorithm>

namespace fathom::pipeline {
namespace {

/// The signed slope: the change of the minor coordinate in one step.
template <class Number>
Number slope_of(const LineAxes& a) {
  if (a.d_major == 0) return number_of<Number>(0);
  return Number(number_of<Number>(a.minor_sign * a.d_minor) / number_of<Number>(a.d_major));
}

/// By how many 2·d_major-ths the exact line is beyond `steps_up` minor steps.
std::int64_t twice_excess(const LineAxes& a, std::int64_t step, std::int64_t steps_up) {
  return static_cast<std::int64_t>(2 * (Int128{step} * a.d_minor - Int128{steps_up} * a.d_major));
}

/// Minor steps made up to a step: the nearest, at a tie the greater minor coordinate.
std::int64_t minor_steps(const LineAxes& a, std::int64_t step) {
  if (a.d_major == 0) return 0;
  const Int128 twice = Int128{2} * step * a.d_minor;
  const Int128 tie_up = a.minor_sign > 0 ? 0 : 1;  // going down, a tie stays
  return static_cast<std::int64_t>(
      floor_quotient(twice + a.d_major - tie_up, Int128{2} * a.d_major));
}

}  // namespace

LineAxes::LineAxes(const LineEnds& ends) {
  const std::int64_t dx = ends.x1 - ends.x0, dy = ends.y1 - ends.y0;
  steep = std::abs(dy) > std::abs(dx);
  major0 = steep ? ends.y0 : ends.x0;
  minor0 = steep ? ends.x0 : ends.y0;
  d_major = std::abs(steep ? dy : dx);
  d_minor = std::abs(steep ? dx : dy);
  major_sign = (steep ? dy : dx) < 0 ? -1 : 1;
  minor_sign = (steep ? dx : dy) < 0 ? -1 : 1;
}

LineAxes::Steps LineAxes::steps_in(const PixelWindow& window) const {
  const std::int64_t begin = steep ? window.y_begin : window.x_begin;
  const std::int64_t end = steep ? window.y_end : window.x_end;
  const std::int64_t first = major_sign > 0 ? begin - major0 : major0 - (end - 1);
  const std::int64_t last = major_sign > 0 ? end - 1 - major0 : major0 - begin;
  return {std::max<std::int64_t>(0, first), std::min(d_major, last)};
}

template <class Number>
void explicit_line(const LineEnds& ends, const PixelWindow& window,
                   const VisitLine<Number>& visit) {
  const LineAxes a(ends);
  const Number m = slope_of<Number>(a);
  const auto [first, last] = a.steps_in(window);
  for (std::int64_t step = first; step <= last; ++step) {
    const Number y = m * number_of<Number>(step) + number_of<Number>(a.minor0);
    const Pixel pixel = a.pixel(step, nearest_integer(y));
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
    const Pixel pixel = a.pixel(step, nearest_integer(y));
    if (window.contains(pixel)) visit(pixel, y);
  }
}

void bresenham_line(const LineEnds& ends, const PixelWindow& window,
                    const VisitLine<std::int64_t>& visit) {
  const LineAxes a(ends);
  const auto [first, last] = a.steps_in(window);
  const std::int64_t steps_up = minor_steps(a, first);
  std::int64_t minor = a.minor0 + a.minor_sign * steps_up;
  std::int64_t error = twice_excess(a, first, steps_up);  // at most d_major in magnitude
  for (std::int64_t step = first; step <= last; ++step) {
    const Pixel pixel = a.pixel(step, minor);
    if (window.contains(pixel)) visit(pixel, error);
    error += 2 * a.d_minor;
    if (error > a.d_major || (error == a.d_major && a.minor_sign > 0)) {
      minor += a.minor_sign;
      error -= 2 * a.d_major;
    }
  }
}

void midpoint_line(const LineEnds& ends, const PixelWindow& window,
                   const VisitLine<std::int64_t>& visit) {
  const LineAxes a(ends);
  const auto [first, last] = a.steps_in(window);
  const std::int64_t steps_up = minor_steps(a, first);
  std::int64_t minor = a.minor0 + a.minor_sign * steps_up;
  std::int64_t d = twice_excess(a, first, steps_up) + 2 * a.d_minor - a.d_major;
  for (std::int64_t step = first; step <= last; ++step) {
    const Pixel pixel = a.pixel(step, minor);
    if (window.contains(pixel)) visit(pixel, d);
    const bool north_east = d > 0 || (d == 0 && a.minor_sign > 0);
    if (north_east) minor += a.minor_sign;
    d += north_east ? 2 * (a.d_minor - a.d_major) : 2 * a.d_minor;
  }
}

template void explicit_line<Exact>(const LineEnds&, const PixelWindow&, const VisitLine<Exact>&);
template void explicit_line<double>(const LineEnds&, const PixelWindow&, const VisitLine<double>&);
template void explicit_line<float>(const LineEnds&, const PixelWindow&, const VisitLine<float>&);
template void dda_line<Exact>(const LineEnds&, const PixelWindow&, const VisitLine<Exact>&);
template void dda_line<double>(const LineEnds&, const PixelWindow&, const VisitLine<double>&);
template void dda_line<float>(const LineEnds&, const PixelWindow&, const VisitLine<float>&);

}  // namespace fathom::pipeline
