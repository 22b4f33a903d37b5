#pragma once

#include <array>

#include "fathom/mesh/mesh.h"

/// Whether a point is inside a mesh. In binary64: good for a warning, not for a decision.
namespace fathom::scene {

/// How often the surface turns around `eye`, a point in the mesh's frame: 1 inside a closed surface
/// whose triangles are counter-clockwise seen from outside, −1 where they are so seen from inside,
/// 0 outside; a fraction where the surface is open.
/// Source   the sum of signed solid angles, by the formula of van Oosterom and Strackee
///          (tan(Ω/2) = det(a, b, c) / (|a||b||c| + …)), over 4π.
double winding_number(const Mesh& mesh, const std::array<double, 3>& eye);

/// Number of triangles through which the ray from `eye` along +x leaves, minus the number through
/// which it enters: the winding number of a closed surface, computed cheaply from one ray.
/// Fails    ElementFault if a triangle has a corner beyond the vertices.
int crossings_along_x(const Mesh& mesh, const std::array<double, 3>& eye);

}  // namespace fathom::scene
