#include "fathom/attribution/model/renderer_input.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/attribution/ray/model_ray.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/projection.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"

namespace fathom::attribution {
namespace {

std::array<double, 3> place(const Object& object, const MeshPoint& p) {
  if (object.placed_as_is) return {p.x, p.y, p.z};
  const WorldPoint world = object.world_from_mesh(p);
  return {round_to_binary64(world.x), round_to_binary64(world.y), round_to_binary64(world.z)};
}

}  // namespace

WorldMesh world_mesh(const Scene& scene) {
  const StandardArithmetic standard;
  require_valid(scene);
  std::size_t points = 0;
  for (const Object& object : scene.objects) points += scene.meshes[object.mesh].vertices.size();
  if (points > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the scene has more than 4294967295 corners, more than a renderer numbers");
  }

  WorldMesh world;
  world.points.reserve(points);
  world.triangles.reserve(triangle_count(scene));
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const auto first = static_cast<std::uint32_t>(world.points.size());
    for (const MeshPoint& p : mesh.vertices) world.points.push_back(place(object, p));
    for (const auto& [a, b, c] : mesh.triangles) {
      world.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return world;
}

std::optional<WorldBounds> box_of(const WorldMesh& mesh) {
  const StandardArithmetic standard;
  if (mesh.points.empty()) return std::nullopt;
  WorldBounds box{mesh.points.front(), mesh.points.front()};
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], p[k]);
      box.upper[k] = std::max(box.upper[k], p[k]);
    }
  }
  return box;
}

ClipRange clip_range(const WorldMesh& mesh, const Camera& camera) {
  if (has_clip_planes(camera)) return {camera.near, camera.far};
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  const auto& r = camera.world_to_camera[2];
  for (const auto& [x, y, z] : mesh.points) {
    const double depth = r[0] * x + r[1] * y + r[2] * z + r[3];
    if (depth <= 0) continue;
    least = std::min(least, depth);
    greatest = std::max(greatest, depth);
  }
  if (greatest == 0) return {1, 2};  // nothing lies in front
  const double far = std::min(greatest * 1.001, camera.far);
  const double near = std::max(least * 0.999, camera.near);
  const bool perspective = is_perspective(camera.projection);
  return {perspective ? std::max(near, far / 1e4) : near, far};
}

Matrix4 eye_from_world(const Camera& camera) {
  const auto& [x, y, z] = camera.world_to_camera;
  return {x[0],  x[1],  x[2],  x[3],  -y[0], -y[1], -y[2], -y[3],
          -z[0], -z[1], -z[2], -z[3], 0,     0,     0,     1};
}

Matrix4 clip_from_eye(const Camera& camera, const ClipRange& range, ClipDepth depth) {
  const auto [xx, xy, x1, yy, y1] =
      RoundedProjection(camera.projection).clip_rows(camera.width, camera.height);
  const double length = range.far - range.near, sum = range.far + range.near;
  const bool reversed = depth == ClipDepth::one_to_zero;
  // The row of z: of the eye's z, and constant.
  const double z_orthographic = (reversed ? 1 : -2) / length;
  const double one_orthographic = (reversed ? range.far : -sum) / length;
  const double z_perspective = (reversed ? range.near : -sum) / length;
  const double one_perspective = (reversed ? 1 : -2) * range.far * range.near / length;
  // clang-format off
  if (is_orthographic(camera.projection)) {
    return {xx, -xy, 0,              x1,
            0,  -yy, 0,              y1,
            0,  0,   z_orthographic, one_orthographic,
            0,  0,   0,              1};
  }
  // Differences, so that no zero becomes negative.
  return {xx, -xy, 0 - x1,        0,
          0,  -yy, 0 - y1,        0,
          0,  0,   z_perspective, one_perspective,
          0,  0,   -1,            0};
  // clang-format on
}

CameraRays camera_rays(const Camera& camera) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Eigen::Matrix3d rotation = camera_from_world.leftCols<3>();
  const Eigen::Matrix3d world_from_camera = rotation.inverse();
  const auto [cx, cy] = principal_point(camera.projection);

  // y = (v − cy)/fy, x = (u − cx − skew·y)/fx on the plane z = 1 (orthographic: on every plane).
  const double fx = camera.projection.fx, fy = camera.projection.fy;
  const double skew = camera.projection.skew / (fx * fy);
  const Vector3 corner(-cx / fx + skew * cy, -cy / fy, 0);
  const Vector3 per_u(1 / fx, 0, 0), per_v(-skew, 1 / fy, 0);
  const bool perspective = is_perspective(camera.projection);
  const Vector3 forward(0, 0, 1), origin = -camera_from_world.col(3);

  CameraRays rays;
  rays.origin.at_corner =
      as_array(world_from_camera * (perspective ? origin : Vector3(origin + corner)));
  rays.direction.at_corner =
      as_array(world_from_camera * (perspective ? Vector3(forward + corner) : forward));
  CameraRays::Affine& moving = perspective ? rays.direction : rays.origin;
  moving.per_u = as_array(world_from_camera * per_u);
  moving.per_v = as_array(world_from_camera * per_v);
  return rays;
}

std::array<float, 16> clip_from_held(const Camera& camera, const RasterModel& model) {
  const std::array<ClipRow, 4> rows = rows_of_camera(camera, model);
  std::array<float, 16> matrix{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      matrix[4 * r + k] =
          static_cast<float>(k < 3 ? rows[r].row[k] / model.scale[k] : rows[r].row[3]);
    }
  }
  return matrix;
}

}  // namespace fathom::attribution
