#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/points.h"

/// Line clipping by the order of parameters.
/// Source   [LB84], with its symbols: the segment is inside at t where p_k t ≤ q_k for the edges
///          k = 1 … 4 (left, right, bottom, top).
namespace fathom::clipping {

enum class Crossing {
  /// p < 0: the line goes from outside to inside at t = q / p.
  entering,
  /// p > 0: from inside to outside.
  leaving,
  /// p = 0, q ≥ 0: parallel to the edge and inside.
  parallel_inside,
  /// p = 0, q < 0: parallel and outside; nothing is visible.
  parallel_outside,
};

/// The line against one edge; k from 1 to 4. If it is parallel, t is 0 and means nothing.
template <class Number>
struct LineParameter {
  int k;
  Number p, q, t;
  Crossing crossing;
};

template <class Number>
struct LiangBarskyTrace {
  /// The four edges: crossings in the order of t (at equal t entering before leaving), then
  /// parallels.
  std::vector<LineParameter<Number>> parameters;
  /// The greatest entering parameter or 0, and the least leaving one or 1. The segment is visible
  /// if no parallel is outside and t_entering ≤ t_leaving; they are equal at a corner touched in
  /// one point.
  Number t_entering, t_leaving;
};

/// The result of the order of the parameters; sorts `parameters` into the order of the trace.
template <class Number>
struct VisibleRange {
  Number t_entering, t_leaving;
  bool visible;
};
template <class Number>
VisibleRange<Number> visible_range(std::vector<LineParameter<Number>>& parameters);

/// The line against the boundary p t ≤ q.
template <class Number>
LineParameter<Number> against_boundary(int k, const Number& p, const Number& q);

/// The part of the segment inside the window, border included; nullopt if there is none.
/// Exact    over Rational. Over double an end that is inside is kept as it is.
template <class Number>
std::optional<Segment2<Number>> liang_barsky(const Segment2<Number>& segment,
                                             const Window<Number>& window,
                                             LiangBarskyTrace<Number>* trace = nullptr);

}  // namespace fathom::clipping
