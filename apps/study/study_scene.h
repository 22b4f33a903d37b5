#pragma once

#include <string>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/image/preview.h"
#include "fathom/pipeline/output/output_merger.h"
#include "fathom/render.h"
#include "fathom/scene/scene.h"

/// Scenes of studies, given by the user or made here, and exact pictures of them.
namespace fathom::studies {

/// Panels at twelve distances from 1 to 400 along the view, tilted, each with a decal 0.01 in front
/// of it and a cover 0.05 in front of the right half of the decal. Object 0: panels and covers;
/// object 1: decals, drawn after them. 640×360 pixels, near 0.01, far 1000.
SceneView panels_with_decals();

/// A wheel of 24 thin spokes, turned by a little, and a rim of triangles: edges in every direction.
/// 320×320 pixels.
SceneView wheel();

/// The scene of the options, or the wheel, with their near and far.
/// Fails    UsageError for a camera that means nothing.
SceneView scene_or_wheel(const StudyOptions& options);

/// The camera with a range for a depth buffer: options first, then what the camera has, then the
/// powers of ten that leave a factor of 20 before and of 2 behind what is visible.
/// Fails    UsageError where options and scene leave nothing visible.
Camera with_range(const SceneView& view, const StudyOptions& options);

/// What is visible: channels Z and id.
DepthMap visible_map(const SceneView& view);

/// NAME.png: a channel with its colour bar.
StudyFile picture(const std::string& name, const DepthMap& map, const PreviewOptions& options);

/// What a picture should be, by the exact engine: in each pixel the colours of the triangles that
/// are visible there, each weighted by its exact visible area (render_deep), and the background by
/// what they leave. Of the pipeline nothing is used: no grid, no transform, no depth buffer.
/// A triangle has the colour of its corners, or is white if its mesh has no colours.
/// Exact    areas, each rounded once to binary32, so a colour is off by less than 2⁻²⁴.
/// Fails    InputError where a triangle's corners differ in colour; as render_deep().
pipeline::ColourImage exact_picture(const Scene& scene, const Camera& camera,
                                    const pipeline::Colour& background = {0, 0, 0});

}  // namespace fathom::studies
