#include "fathom/pipeline/scan/line.h"

#include <algorithm>

#include "fathom/pipeline/scan/line-inl.h"

namespace fathom::pipeline {
namespace {

/// By how many 2·d_major-ths the exact line is beyond `steps_up` minor steps.
std::int64_t twice_excess(const LineAxes& a, std::int64_t step, std::int64_t steps_up) {
  return static_cast<std::int64_t>(2 * (Int128{step} * a.d_minor - Int128{steps_up} * a.d_major));
}

/// Minor steps made up to a step: the nearest.
std::int64_t minor_steps(const LineAxes& a, std::int64_t step) {
  if (a.d_major == 0) return 0;
  const Int128 twice = Int128{2} * step * a.d_minor + a.d_major, unit = Int128{2} * a.d_major;
  const auto steps = static_cast<std::int64_t>(floor_quotient(twice, unit));
  const bool tie = twice % unit == 0;
  return tie && !a.steps_at_tie(a.minor0 + a.minor_sign * (steps - 1)) ? steps - 1 : steps;
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
  ties = ends.ties;
}

LineAxes::Steps LineAxes::steps_in(const PixelWindow& window) const {
  const std::int64_t begin = steep ? window.y_begin : window.x_begin;
  const std::int64_t end = steep ? window.y_end : window.x_end;
  const std::int64_t first = major_sign > 0 ? begin - major0 : major0 - (end - 1);
  const std::int64_t last = major_sign > 0 ? end - 1 - major0 : major0 - begin;
  return {std::max<std::int64_t>(0, first), std::min(d_major, last)};
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
    if (error > a.d_major || (error == a.d_major && a.steps_at_tie(minor))) {
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
    const bool north_east = d > 0 || (d == 0 && a.steps_at_tie(minor));
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
