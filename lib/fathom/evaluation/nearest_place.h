#pragma once

#include <utility>

#include "fathom/evaluation/distance_bounds.h"

namespace fathom::evaluation {

/// Approximate nearest point of a triangle, as A + v·(B − A) + w·(C − A). Has no error bound: its
/// users are right for any v and w, and tight for good values.
/// Source   [Eri05] 5.1.5
inline std::pair<double, double> nearest_place(const PlacedTriangles::Corners& corners,
                                               const Vector& p) {
  const auto& [a, b, c] = corners;
  const Vector ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const Vector bp = minus(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const Vector cp = minus(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  const double sum = va + vb + vc;
  return {vb / sum, vc / sum};
}

}  // namespace fathom::evaluation
