#pragma once

#include <array>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/triangle_source.h"

/// Cameras that see the same triangles as a distant light or a lamp. Their poses are not rotations,
/// so that nothing is rounded; shares of triangles do not depend on the difference.
namespace fathom::area {

/// The camera whose image contains the whole scene along a direction d: with k the axis of the
/// greatest |d_k| and i, j the next two in cyclic order, u and v are x_i·d_k − x_k·d_i and
/// x_j·d_k − x_k·d_j times a power of two, shifted; D is −sign(d_k)·x_k, shifted.
/// Fails    UsageError if the direction is 0 or not finite, or if the power or the shift is not a
///          number of binary64.
Camera camera_of_direction(const TriangleSource& triangles, const std::array<double, 3>& direction);

/// Six cameras of 90° around a point, along the axes.
/// Fails    UsageError if the point is not finite.
std::vector<Camera> cameras_of_point(const std::array<double, 3>& point);

}  // namespace fathom::area
