#pragma once

#include <array>
#include <vector>

#include "fathom/clipping/points.h"

/// Cubic Bézier curves, in binary64, as lines that are as fine as they need to be.
namespace fathom::pipeline {

using PlanePoint = clipping::Point2<double>;

/// From the first to the last of four control points; the two between pull.
struct CubicBezier {
  std::array<PlanePoint, 4> control;

  /// The point at t in [0, 1], by de Casteljau: means of means of neighbouring control points.
  [[nodiscard]] PlanePoint at(double t) const;
  /// The parts before and after t, as curves of their own.
  [[nodiscard]] std::array<CubicBezier, 2> divided_at(double t) const;
  [[nodiscard]] CubicBezier scaled(double factor) const;
};

/// A bound on how far the chord from the first to the last control point is from the curve,
/// comparing points of the same t.
///
/// A function that is twice differentiable is at most max|f″|/8 from its chord over [0, 1]; B″ is a
/// mean of 6·(b₀ − 2b₁ + b₂) and 6·(b₁ − 2b₂ + b₃), so the longer of the two, times 6/8.
double chord_error(const CubicBezier& curve);

/// The curve as points from its first to its last, chords of which are at most `tolerance` away
/// from it: parts are divided in the middle until the bound above proves it. Each division makes
/// the bound at least almost four times as small.
/// Fails    UsageError unless the control points are finite and the tolerance is at least 2⁻⁴⁰ of
///          their greatest distance from each other: nothing finer is told apart.
std::vector<PlanePoint> flattened(const CubicBezier& curve, double tolerance);

/// ∫ (x dy − y dx)/2 along the curve: for an outline of several, the sum of these is its area,
/// positive if it runs counter-clockwise with y up.
double area_beside(const CubicBezier& curve);

}  // namespace fathom::pipeline
