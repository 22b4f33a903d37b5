#pragma once

#include <cstdint>
#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/scene/scene.h"

/// Solids whose corners and edges are met by many rays.
namespace fathom::rays::test {

/// The sheared surface of a solid made of unit cubes: closed, oriented outwards, with edges and
/// corners at which many triangles meet, and needles of no area where faces are split.
Scene voxel_solid(std::uint64_t seed);
/// Rays at corners, edges and faces of its cubes.
std::vector<Ray> rays_at_voxels(std::uint64_t seed, int count);

}  // namespace fathom::rays::test
