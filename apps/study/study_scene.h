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

/// The camera with a range for a depth buffer, from the options, else from the camera, else the
/// powers of ten that leave a factor of 20 in front of the visible surfaces and a factor of 2
/// behind them.
/// Fails    UsageError if nothing is visible with these options.
Camera with_range(const SceneView& view, const StudyOptions& options);

/// The exact map of the view, with channels Z and id.
DepthMap visible_map(const SceneView& view);

/// NAME.png: a channel with its colour bar.
StudyFile picture(const std::string& name, const DepthMap& map, const PreviewOptions& options);

/// The correct picture, by the exact engine. The colour of a pixel is the mean of the colours of
/// its visible triangles, each weighted by its exact visible area (render_deep), and of the
/// background in the remaining area. It uses nothing of the pipeline: no grid, no transform, no
/// depth buffer. A triangle has the colour of its corners, or is white if its mesh has no colours.
/// Exact    areas, each rounded once to binary32, so a colour is off by less than 2⁻²⁴.
/// Fails    InputError if a triangle's corners differ in colour; as render_deep().
pipeline::ColourImage exact_picture(const Scene& scene, const Camera& camera,
                                    const pipeline::Colour& background = {0, 0, 0});

}  // namespace fathom::studies
