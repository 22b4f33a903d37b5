#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/geometry/frames.h"

namespace fathom::mesh {

/// How a face was cut into triangles.
enum class Triangulation {
  /// A fan from the first corner: a triangle or a ring that is convex in its projection.
  convex_fan,
  ear_clipping,
  /// A fan of what remained: the ring is not simple, has no normal, or ran out of ears.
  fallback_fan,
};

/// Cuts a face of n ≥ 3 corners into n − 2 triangles, appended to `triangles` as numbers of corners
/// (specification, section 3). A fan is (0, k, k+1) for k = 1 … n−2; an ear is written (corner
/// before, middle, corner after), in the order in which ears are cut.
///
/// Exact    every test, for all finite coordinates; no corner is moved or dropped. A corner that
///          repeats the one before it does not affect convexity or simplicity.
/// Cost     n for convex rings; n log n to know whether a ring is simple; clip_ears() for ears.
/// Source   [Mei75]: a simple polygon has ears; [SSS74]: Newell's normal.
Triangulation triangulate_face(std::span<const MeshPoint> ring,
                               std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The axis, 0 to 2, along which a face is projected: the axis of the component of its Newell
/// normal that has the largest magnitude, the first among equals; −1 if the normal is zero. Exact.
int projection_axis(std::span<const MeshPoint> ring);

}  // namespace fathom::mesh
