#include "fathom/clipping/liang_barsky.h"

#include <algorithm>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

template <class Number>
std::vector<LineParameter<Number>> against_window(const Segment2<Number>& s,
                                                  const Window<Number>& window) {
  const auto& [start, end] = s;
  const Number dx = end.x - start.x, dy = end.y - start.y;
  return {against_boundary<Number>(1, -dx, start.x - window.xmin),
          against_boundary<Number>(2, dx, window.xmax - start.x),
          against_boundary<Number>(3, -dy, start.y - window.ymin),
          against_boundary<Number>(4, dy, window.ymax - start.y)};
}

bool is_parallel(Crossing crossing) {
  return crossing == Crossing::parallel_inside || crossing == Crossing::parallel_outside;
}

/// Crossings before parallels, by t, entering before leaving.
template <class Number>
bool comes_before(const LineParameter<Number>& a, const LineParameter<Number>& b) {
  if (is_parallel(a.crossing) || is_parallel(b.crossing))
    return !is_parallel(a.crossing) && is_parallel(b.crossing);
  return a.t < b.t || (a.t == b.t && a.crossing < b.crossing);
}

}  // namespace

template <class Number>
LineParameter<Number> against_boundary(int k, const Number& p, const Number& q) {
  if (p == 0)
    return {k, p, q, Number(0), q < 0 ? Crossing::parallel_outside : Crossing::parallel_inside};
  return {k, p, q, q / p, p < 0 ? Crossing::entering : Crossing::leaving};
}

template <class Number>
VisibleRange<Number> visible_range(std::vector<LineParameter<Number>>& parameters) {
  std::stable_sort(parameters.begin(), parameters.end(), comes_before<Number>);
  VisibleRange<Number> range{Number(0), Number(1), true};
  for (const LineParameter<Number>& parameter : parameters) {
    const auto& [k, p, q, t, crossing] = parameter;
    if (crossing == Crossing::entering) range.t_entering = std::max(range.t_entering, t);
    if (crossing == Crossing::leaving) range.t_leaving = std::min(range.t_leaving, t);
    if (crossing == Crossing::parallel_outside) range.visible = false;
  }
  range.visible = range.visible && range.t_entering <= range.t_leaving;
  return range;
}

template <class Number>
std::optional<Segment2<Number>> liang_barsky(const Segment2<Number>& segment,
                                             const Window<Number>& window,
                                             LiangBarskyTrace<Number>* trace) {
  const StandardArithmetic standard;
  check_window(window);
  auto parameters = against_window(segment, window);
  const auto [t_entering, t_leaving, visible] = visible_range(parameters);
  if (trace != nullptr) *trace = {parameters, t_entering, t_leaving};
  if (!visible) return std::nullopt;

  const auto& [start, end] = segment;
  return Segment2<Number>{t_entering == 0 ? start : interpolate(start, end, t_entering),
                          t_leaving == 1 ? end : interpolate(start, end, t_leaving)};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                    \
  template LineParameter<Number> against_boundary(int, const Number&, const Number&); \
  template VisibleRange<Number> visible_range(std::vector<LineParameter<Number>>&);   \
  template std::optional<Segment2<Number>> liang_barsky(                              \
      const Segment2<Number>&, const Window<Number>&, LiangBarskyTrace<Number>*);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
