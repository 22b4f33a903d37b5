#pragma once

#include <string>
#include <vector>

#include "validation/bench/measurement.h"

namespace fathom::bench {

/// The renderers that are timed apart: fast, reference and, where they are built in, vtk, embree
/// and embree-robust.
///
///   fast, reference        from mesh and camera in memory to the complete map in memory, nothing
///                          kept from an earlier frame
///   vtk                    drawing and waiting until it is done; depths are not read back, and the
///                          mesh was handed to OpenGL with the first frame
///   embree, embree-robust  making rays, tracing them, storing depths; the hierarchy was built
///                          before. With the first comes embree-build, the building
///
/// Does     make the scene, then keep to the processors of the plan.
/// Fails    InputError as make_scene, or where a renderer does not start.
std::vector<Measurement> measure(const std::string& renderer, const Plan& plan);

/// measure() in a process of its own, for its peak of memory and its threads to be its own.
/// Needs    a process that has started no threads.
std::vector<Measurement> measure_in_child(const std::string& renderer, const Plan& plan);

/// The triangles of a plan's scene, which is made in a process of its own.
/// Needs    a process that has started no threads. Fails as make_scene.
std::uint64_t count_triangles_in_child(const Plan& plan);

/// Whether VTK and Embree are built in.
bool peers_are_built();

}  // namespace fathom::bench
