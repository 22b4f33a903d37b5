#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/mesh/mesh.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/scene.h"

/// The scene as other renderers are given it.
namespace fathom::attribution {

/// All triangles of a scene as one mesh, numbered as in the scene.
///
/// Frame    world, scene units.
/// Exact    points of objects without a transform; points of other objects are rounded once, to
///          binary64.
struct WorldMesh {
  std::vector<std::array<double, 3>> points;
  MeshArray<CornerIndices> triangles;
};

/// Fails    InputError if the scene has a fault (find_fault), or more than 2³² − 1 corners in all.
WorldMesh world_mesh(const Scene& scene);

/// The smallest box that contains every point, whether a triangle uses it or not. nullopt if there
/// is no point.
std::optional<WorldBounds> box_of(const WorldMesh& mesh);

// The camera in the form of other renderers: OpenGL's matrices and rays. OpenGL's eye space has x
// to the right, y up, z backward; clip space is as in [GL46] 13.7, −w ≤ z ≤ w.

/// Row by row, for column vectors.
using Matrix4 = std::array<double, 16>;

/// The clip planes, as depths in scene units.
struct ClipRange {
  double near = 0, far = 0;
};

/// The camera's own near and far if it has both; otherwise planes just outside the corners that lie
/// in front of the camera, with near at least far/10⁴ (perspective).
ClipRange clip_range(const WorldMesh& mesh, const Camera& camera);

/// Exact    only signs are changed.
Matrix4 eye_from_world(const Camera& camera);

/// Where near and far go: to z = −w and z = w, as is usual in OpenGL, or to z = w and z = 0, which
/// needs glClipControl.
enum class ClipDepth { minus_one_to_one, one_to_zero };

/// Maps the image point (u, v) in pixels to x = 2u/width − 1, y = 1 − 2v/height.
/// Exact    each entry is rounded to binary64 a few times.
Matrix4 clip_from_eye(const Camera& camera, const ClipRange& range,
                      ClipDepth depth = ClipDepth::minus_one_to_one);

/// The viewing rays of a camera as affine functions of the image position: (u, v) shows the points
/// origin + D·direction, so that the parameter along the ray is the depth D.
///
/// Frame    world, scene units; (u, v) in pixels, (0, 0) the top left corner of the image.
/// Exact    rounded to binary64 several times: good enough for renderers that compute in binary32.
struct CameraRays {
  /// f(u, v) = at_corner + u·per_u + v·per_v
  struct Affine {
    std::array<double, 3> at_corner{}, per_u{}, per_v{};
  };
  Affine origin, direction;
};

CameraRays camera_rays(const Camera& camera);

/// The matrix from held positions, (position − shift)·scale, to OpenGL's clip coordinates, row by
/// row. Ignores a matrix that the model already has.
///
/// Needs    near and far of the camera as the model's mapping does.
/// Exact    made in binary64, each entry then rounded to binary32.
std::array<float, 16> clip_from_held(const Camera& camera, const RasterModel& model);

}  // namespace fathom::attribution
