#pragma once

#include <array>

#include "fathom/pipeline/geometry/window_transform.h"

/// Culling stage, and the three tests of the textbooks for which side of a triangle is seen.
///
/// In exact arithmetic they agree for triangles in front of the eye. Rounded, each test has errors
/// of its own; the test in the window tests the triangle as it will be drawn.
namespace fathom::pipeline {

enum class Facing { front, back, edge_on };

/// The sign of the determinant in the window, which is twice the signed area: front if the corners
/// run, as seen, in the direction of `front_face`.
/// Source   [GL46] 14.6.1
template <class Real>
Facing facing_in_window(const std::array<WindowVertex<Real>, 3>& triangle, FrontFace front_face);

/// The z component of the cross product of the edges in normalised device coordinates (y up): if it
/// is > 0, the corners run counter-clockwise as seen.
template <class Real>
Facing facing_in_ndc(const std::array<NdcVertex<Real>, 3>& triangle, FrontFace front_face);

/// N·V in the world, where V points from a corner of this face to the eye; for an orthographic view
/// V is the direction towards the viewer. `mirrored`: camera and world differ in handedness.
template <class Real>
Facing facing_in_world(const std::array<WorldVertex<Real>, 3>& triangle,
                       const std::array<double, 3>& eye_or_direction, bool perspective,
                       bool mirrored, FrontFace front_face);

constexpr bool is_culled(Facing facing, Culling culling) {
  return facing == Facing::edge_on || (culling == Culling::back && facing == Facing::back) ||
         (culling == Culling::front && facing == Facing::front);
}

}  // namespace fathom::pipeline
