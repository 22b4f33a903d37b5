#pragma once

#include <string>

#include "apps/study/study.h"
#include "fathom/image/preview.h"
#include "fathom/render.h"

/// Scenes that studies look at: one that was given, or one of their own.
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

}  // namespace fathom::studies
