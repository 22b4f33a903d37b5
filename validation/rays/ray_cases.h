#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/rays/ray.h"

/// Meshes and rays on which engines that trace rays are compared with the truth.
namespace fathom::validation {

/// All numbers are binary32, which every engine takes as they are.
struct RayCase {
  std::string scene;
  /// How the rays are made, see below.
  std::string rays_name;
  attribution::WorldMesh mesh;
  std::vector<Ray> rays;
};

/// The rays of a scene, `count` of each kind; the same at each call:
/// - random: from around the scene, aimed into it
/// - inside: from within its box, in any direction
/// - edges: from around the scene, aimed at a point of an edge
/// - corners: from around the scene, aimed at a corner
/// A mesh is rounded to binary32 first.
/// Fails    InputError if the mesh has no triangle, or a number is beyond binary32.
std::vector<RayCase> ray_cases(const std::string& scene, const attribution::WorldMesh& mesh,
                               std::size_t count);

/// Cases that have a mesh of their own:
/// - square: a square that is divided into 1024 triangles by points at random heights, seen along
///   parallel rays through the centres of a grid: every ray has a hit. The mesh and the rays of the
///   Vulkan conformance tests (ray_tracing_pipeline, watertightness), from another random generator
/// - voxels: a closed surface of unit squares, and rays between points of a grid of halves: most
///   pass exactly through edges or corners
std::vector<RayCase> made_ray_cases(std::size_t count);

}  // namespace fathom::validation
