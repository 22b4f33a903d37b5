#pragma once

#include "fathom/camera/camera.h"
#include "fathom/pipeline/output/output_merger.h"
#include "fathom/scene/scene.h"

namespace fathom::studies {

/// What a picture should be, by the exact engine: in each pixel the colours of the triangles that
/// are visible there, each weighted by its exact visible area (render_deep), and the background by
/// what they leave. Of the pipeline nothing is used: no grid, no transform, no depth buffer.
/// A triangle has the colour of its corners, or is white if its mesh has no colours.
/// Exact    areas, each rounded once to binary32, so a colour is off by less than 2⁻²⁴.
/// Fails    InputError where a triangle's corners differ in colour; as render_deep().
pipeline::ColourImage exact_picture(const Scene& scene, const Camera& camera,
                                    const pipeline::Colour& background = {0, 0, 0});

}  // namespace fathom::studies
