#pragma once

#include "fathom/attribution/model/renderer_input.h"
#include "validation/drawn_map.h"

namespace fathom::validation {

/// How far a sample may lie off the centre of its pixel: ½/1024 of the filter's width, and as much
/// for the roundings of its table.
inline constexpr double blender_sample_error = 1e-5;

/// The mesh rendered by Blender's Cycles on the processor: one sample per pixel, the Depth pass of
/// a multilayer EXR. A mesh far from the origin is moved there, because Blender holds positions in
/// binary32. Depths of a panorama (panorama_of()) are distances; the model has no rays of it.
/// Fails    InputError if there is no Blender, if it fails, or if it cannot express the camera.
DrawnMap draw_blender(const attribution::WorldMesh& mesh, const Camera& camera);

}  // namespace fathom::validation
