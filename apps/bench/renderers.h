#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/measurement.h"
#include "validation/scenes/scenes.h"

namespace fathom::bench {

/// Times one renderer: fast, fast-kept, reference and, if they are built in, vtk, embree,
/// embree-robust or masked-occlusion-culling.
///
///   fast, reference        from mesh and camera in memory to the complete map in memory; nothing
///                          is kept from an earlier frame
///   fast-kept              the same, but into the map of the frame before and with the memory that
///                          it worked with (render_into(), RenderMemory): what a frame of a path
///                          costs, as vtk and embree keep their buffers
///   vtk                    drawing and waiting until it is done; depths are not read back, and the
///                          mesh was passed to OpenGL with the first frame
///   embree, embree-robust  making rays, tracing them, storing depths; the hierarchy has already
///                          been built. embree-build, returned with embree, is building it
///   masked-occlusion-culling
///                          from vertices in the world, in binary32, and a cleared buffer to all
///                          triangles drawn into it; one thread, whatever the plan says. Depths of
///                          pixels, which are not read, would be bounds: two for each 8×4 pixels.
///                          Nothing is returned for an orthographic camera, which it does not know
///
/// Does     make the scene and restrict this process to the processors of the plan.
/// Fails    InputError as make_scene(), or if the renderer does not start; UsageError if there is
///          no such renderer.
std::vector<Measurement> measure(const std::string& renderer, const Plan& plan);

/// measure() in a process of its own, so that its peak memory and its threads are its own.
/// Needs    a process that has started no threads.
std::vector<Measurement> measure_in_child(const std::string& renderer, const Plan& plan);

/// The number of triangles of a plan's scene, which is made in a process of its own.
/// Needs    a process that has started no threads.
/// Fails    as make_scene().
std::uint64_t count_triangles_in_child(const Plan& plan);

/// Whether VTK and Embree are built in.
bool peers_are_built();

/// Whether Masked Occlusion Culling is.
bool masked_occlusion_culling_is_built();

// VTK, Embree and Masked Occlusion Culling on a bench scene. `idle_bytes` is the memory that the
// process used before it made the scene.

std::vector<Measurement> measure_vtk(BenchScene bench, const Plan& plan, std::uint64_t idle_bytes);
std::vector<Measurement> measure_embree(BenchScene bench, const Plan& plan, bool robust,
                                        std::uint64_t idle_bytes);
/// Nothing if the camera is orthographic.
std::vector<Measurement> measure_masked_occlusion_culling(BenchScene&& bench, const Plan& plan,
                                                          std::uint64_t idle_bytes);

}  // namespace fathom::bench
