#pragma once

#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/numeric/exact_polynomial.h"
#include "fathom/triangle/projected_triangle.h"

/// Decisions about triangles that cover a sample, as signs of exact forms (specification, section
/// 5). They are the reference engine's own: the fast engine has separate code for them.
namespace fathom::reference {

/// near ≤ |T|·|d|/w ≤ far, of the ray distances of one triangle: signs of quadratic forms.
class DistanceRange {
 public:
  DistanceRange(const triangle::ProjectedTriangle& t, const Camera& camera);

  [[nodiscard]] bool contains(const triangle::Sample& s, TierCounts& counts) const;

 private:
  std::optional<QuadraticForm> above_near_, above_far_;
};

/// D > 0 and near ≤ D ≤ far as signs of forms, for one triangle: D = n/w with w > 0 at covered
/// samples, so D ≥ near ⇔ n − near·w ≥ 0. For lenses with rays that need not go forwards, the ray
/// distance replaces D.
class DepthRange {
 public:
  /// `t` must outlive it.
  DepthRange(const triangle::ProjectedTriangle& t, const Camera& camera);

  [[nodiscard]] bool contains(const triangle::Sample& s, TierCounts& counts) const;

 private:
  const LinearForm& depth_;
  std::optional<LinearForm> above_near_, above_far_;
  std::optional<DistanceRange> distance_;
};

/// The sign of t_b − t_a, exactly, where both triangles cover the sample of a ray: positive if `a`
/// is nearer.
Sign order_along(const triangle::ProjectedTriangle& a, const triangle::ProjectedTriangle& b,
                 const lens::ExactDirection& d);

}  // namespace fathom::reference
