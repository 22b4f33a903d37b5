#pragma once

#include <array>

#include "fathom/attribution/world_mesh.h"
#include "fathom/camera/camera.h"

/// Our camera in the words of OpenGL: eye space is x right, y up, z backward; clip space is that of
/// [GL46], section 13.7, −w ≤ z ≤ w.
namespace fathom::attribution {

/// Row by row, for column vectors.
using Matrix4 = std::array<double, 16>;

/// The clip planes, as depths.
struct ClipRange {
  double near = 0, far = 0;
};

/// The camera's own near and far where it has both; else planes just outside the corners that lie
/// in front of the camera, near not below far/10⁴ (perspective).
ClipRange clip_range(const WorldMesh& mesh, const Camera& camera);

/// Exact: signs only are changed.
Matrix4 eye_from_world(const Camera& camera);

/// Where near and far go: z = −w and z = w, as OpenGL has it, or z = w and z = 0, which needs
/// glClipControl.
enum class ClipDepth { minus_one_to_one, one_to_zero };

/// Rounded to binary64, entry by entry: the image point (u, v) goes to x = 2u/width − 1,
/// y = 1 − 2v/height.
Matrix4 clip_from_eye(const Camera& camera, const ClipRange& range,
                      ClipDepth depth = ClipDepth::minus_one_to_one);

}  // namespace fathom::attribution
