#pragma once

#include "apps/study/study.h"

namespace fathom::studies {

/// More triangles than this are refused: the painter's algorithm compares every pair of them.
inline constexpr std::size_t most_triangles_to_paint = 20000;

/// A scene as an eye at the origin sees it that looks along +z: one mesh in the camera's frame,
/// each corner rounded once to binary64, without triangles beyond far, and cut off at near, where a
/// triangle may become two. The camera keeps its lens.
/// Fails    UsageError for a camera that is orthographic or has a skew, and for more than
///          most_triangles_to_paint triangles
SceneView seen_from_eye(const SceneView& view);

/// Every so many triangles of a scene of one mesh, `count` in all.
Scene thinned(const Scene& scene, std::size_t count);

}  // namespace fathom::studies
