#pragma once

#include <cstdint>
#include <vector>

#include "apps/bench/measurement.h"
#include "validation/scenes/scenes.h"

/// VTK, Embree and Masked Occlusion Culling on a bench scene; see renderers.h. `idle_bytes` is the
/// memory that the process used before it made the scene.
namespace fathom::bench {

std::vector<Measurement> measure_vtk(BenchScene bench, const Plan& plan, std::uint64_t idle_bytes);
std::vector<Measurement> measure_embree(BenchScene bench, const Plan& plan, bool robust,
                                        std::uint64_t idle_bytes);
/// Nothing if the camera is orthographic.
std::vector<Measurement> measure_masked_occlusion_culling(BenchScene&& bench, const Plan& plan,
                                                          std::uint64_t idle_bytes);

}  // namespace fathom::bench
