#pragma once

#include <array>
#include <optional>
#include <utility>

#include "fathom/geometry/frames.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rays/ray.h"

/// Section 11 of the specification in exact numbers: the referee of every doubtful decision.
namespace fathom::rays {

ExactVector3 difference(const WorldPoint& a, const WorldPoint& b);

/// Whether all numbers of a ray are finite, so that it is an exact ray.
bool is_finite(const Ray& ray);

struct ExactRay {
  ExactVector3 origin, direction;

  ExactRay() = default;
  explicit ExactRay(const Ray& ray);
  ExactRay(ExactVector3 from, ExactVector3 along)
      : origin(std::move(from)), direction(std::move(along)) {}
};

/// The ray that is at `from` for t = 0 and at `to` for t = 1.
ExactRay ray_between(const WorldPoint& from, const WorldPoint& to);

/// How a ray meets a triangle.
struct ExactHit {
  /// Where the ray meets the triangle. If only the moved ray meets the triangle, t of the plane and
  /// the ray itself.
  Ratio t;
  /// The sign of n·d: negative for a front face.
  Sign side = Sign::zero;
  /// n, and the numerators of the weights of B and C, whose divisor is n·d.
  ExactVector3 normal;
  std::array<Dyadic, 2> weights;
  Dyadic divisor;
};

/// The hit, if the ray meets the triangle, at any t. Of triangles that share an edge or a corner,
/// and of a closed surface, a ray meets as many as if its origin were moved by (ε, ε², ε³) for an
/// infinitely small ε > 0: it meets no edge then. If edges are closed, a ray meets every triangle
/// that it has a point in common with and is not parallel to.
/// Source   [EM90]
std::optional<ExactHit> meet(const ExactRay& ray, const std::array<WorldPoint, 3>& corners,
                             EdgeRule edges = EdgeRule::generic);

/// The hit of a triangle that has been found to be met.
/// Fails    InputError if it is not met: the scene has changed since.
ExactHit require_hit(const ExactRay& ray, const std::array<WorldPoint, 3>& corners);

/// Whether a hit counts at this t.
bool counts(const Ratio& t, const RaySegment& segment);
/// Whether culling keeps a triangle whose n·d has this sign.
bool is_kept(Sign side, Cull cull);

}  // namespace fathom::rays
