#include "fathom/clipping/cohen_sutherland.h"

#include <algorithm>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

/// The first edge of the window beyond which a point with this code lies.
Outcode first_edge(Outcode code) {
  for (const Outcode edge : {outcode::left, outcode::right, outcode::bottom, outcode::top})
    if (code & edge) return edge;
  return outcode::inside;
}

/// The value at `at` of the linear function that is v0 at u0 and v1 at u1. Rounding must not take
/// it beyond v0 or v1: the segment only ever becomes shorter.
template <class Number>
Number value_at(const Number& at, const Number& u0, const Number& v0, const Number& u1,
                const Number& v1) {
  const Number value = v0 + (v1 - v0) * ((at - u0) / (u1 - u0));
  return std::clamp(value, std::min(v0, v1), std::max(v0, v1));
}

/// Where the segment meets an edge of the window.
template <class Number>
Point2<Number> intersection(const Segment2<Number>& s, const Window<Number>& window, Outcode edge) {
  const auto& [A, B] = s;
  if (edge == outcode::left || edge == outcode::right) {
    const Number x = edge == outcode::left ? window.xmin : window.xmax;
    return {x, value_at(x, A.x, A.y, B.x, B.y)};
  }
  const Number y = edge == outcode::bottom ? window.ymin : window.ymax;
  return {value_at(y, A.y, A.x, B.y, B.x), y};
}

int test_of(Outcode E_1, Outcode E_2) {
  if (E_1 == 0 && E_2 == 0) return 1;
  if ((E_1 & E_2) != 0) return 2;
  return E_1 == 0 || E_2 == 0 ? 3 : 4;
}

}  // namespace

template <class Number>
void check_window(const Window<Number>& window) {
  if (!(window.xmin <= window.xmax))
    throw InputError("the window's xmin is greater than its xmax; expected xmin,ymin,xmax,ymax");
  if (!(window.ymin <= window.ymax))
    throw InputError("the window's ymin is greater than its ymax; expected xmin,ymin,xmax,ymax");
}

template <class Number>
Outcode outcode_of(const Point2<Number>& p, const Window<Number>& window) {
  Outcode code = outcode::inside;
  if (p.x < window.xmin) code |= outcode::left;
  if (p.x > window.xmax) code |= outcode::right;
  if (p.y < window.ymin) code |= outcode::bottom;
  if (p.y > window.ymax) code |= outcode::top;
  return code;
}

std::string to_bits(Outcode code) {
  std::string bits;
  for (const Outcode edge : {outcode::top, outcode::bottom, outcode::right, outcode::left})
    bits += code & edge ? '1' : '0';
  return bits;
}

template <class Number>
std::optional<Segment2<Number>> cohen_sutherland(const Segment2<Number>& segment,
                                                 const Window<Number>& window,
                                                 std::vector<CohenSutherlandStep<Number>>* trace) {
  const StandardArithmetic standard;
  check_window(window);
  Segment2<Number> s = segment;
  for (;;) {
    const Outcode E_1 = outcode_of(s.start, window), E_2 = outcode_of(s.end, window);
    CohenSutherlandStep<Number> step{s, E_1, E_2, test_of(E_1, E_2)};
    if (step.test >= 3) {
      step.moved = E_1 != 0 ? 1 : 2;
      step.edge = first_edge(E_1 != 0 ? E_1 : E_2);
      Point2<Number>& outer = step.moved == 1 ? s.start : s.end;
      outer = intersection(s, window, step.edge);
    }
    if (trace != nullptr) trace->push_back(step);
    if (step.test == 1) return s;
    if (step.test == 2) return std::nullopt;
  }
}

template void check_window(const Window<double>&);
template void check_window(const Window<Rational>&);
template Outcode outcode_of(const Point2<double>&, const Window<double>&);
template Outcode outcode_of(const Point2<Rational>&, const Window<Rational>&);
template std::optional<Segment2<double>> cohen_sutherland(
    const Segment2<double>&, const Window<double>&, std::vector<CohenSutherlandStep<double>>*);
template std::optional<Segment2<Rational>> cohen_sutherland(
    const Segment2<Rational>&, const Window<Rational>&,
    std::vector<CohenSutherlandStep<Rational>>*);

}  // namespace fathom::clipping
