#pragma once

#include <array>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/triangle_source.h"

/// Cameras whose images show what a distant light or a lamp sees. Their poses are no rotations;
/// shares of triangles do not depend on that, and nothing is rounded.
namespace fathom::area {

/// The camera whose image contains the whole scene along a direction d: with k the axis of the
/// greatest |d_k| and i, j the next two in cyclic order, u and v are x_i·d_k − x_k·d_i and
/// x_j·d_k − x_k·d_j times a power of two, shifted; D is −sign(d_k)·x_k, shifted.
/// Fails    UsageError if the direction is 0 or not finite, or if no number of binary64 can be that
///          power or that shift.
Camera camera_of_direction(const TriangleSource& triangles, const std::array<double, 3>& direction);

/// Six cameras of 90° around a point, along the axes.
/// Fails    UsageError if the point is not finite.
std::vector<Camera> cameras_of_point(const std::array<double, 3>& point);

}  // namespace fathom::area
