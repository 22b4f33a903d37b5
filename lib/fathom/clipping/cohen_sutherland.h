#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/clipping/points.h"

/// Line clipping with outcodes.
/// Source   [NS79] 5-1, which prints the algorithm of Danny Cohen and Ivan Sutherland, 1967.
namespace fathom::clipping {

/// Four bits: on which sides of the window a point is outside. A point on the border is inside.
using Outcode = std::uint8_t;
namespace outcode {
constexpr Outcode inside = 0b0000;
constexpr Outcode left = 0b0001;
constexpr Outcode right = 0b0010;
constexpr Outcode bottom = 0b0100;
constexpr Outcode top = 0b1000;
}  // namespace outcode

template <class Number>
Outcode outcode_of(const Point2<Number>& point, const Window<Number>& window);

/// "1001": top, bottom, right, left.
std::string to_bits(Outcode code);

/// One look at the segment: its outcodes E1 and E2, and which of the four tests held.
///   1  E1 = E2 = 0              visible
///   2  E1 & E2 ≠ 0              invisible
///   3  one of them 0            split at an edge of the window
///   4  both ≠ 0, E1 & E2 = 0    split at an edge of the window
template <class Number>
struct CohenSutherlandStep {
  Segment2<Number> segment;
  Outcode E1, E2;
  int test;
  /// If test 3 or 4 held: the edge, one bit, at which the segment is split, and the end (1 or 2)
  /// that moves there. The rest is tested again in the next step.
  Outcode edge = outcode::inside;
  int moved = 0;
};

/// The part of the segment inside the window, border included; nullopt if there is none.
///
/// Exact    over Rational. Over double each intersection is rounded, and a coordinate that has been
///          moved to an edge of the window lies exactly on it.
/// Ends     after at most four splits, each of which moves one end to an edge: an end that is no
///          longer outside at an edge never gets outside there again unless the other end is too.
template <class Number>
std::optional<Segment2<Number>> cohen_sutherland(
    const Segment2<Number>& segment, const Window<Number>& window,
    std::vector<CohenSutherlandStep<Number>>* trace = nullptr);

}  // namespace fathom::clipping
