#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "fathom/attribution/model/renderer_input.h"

/// Our camera as rays and as OpenGL's matrices: both say what the specification says.
namespace fathom::attribution {
namespace {

Camera odd_camera(ProjectionModel projection) {
  Camera camera{.width = 160, .height = 90, .projection = {.model = projection}};
  camera.projection.fx = 150;
  camera.projection.fy = -130;  // mirrored
  camera.projection.cx = 70.25;
  camera.projection.cy = 48.5;
  camera.projection.skew = 12;
  camera.projection.pixel_centre = 0;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.1}, {-0.1, 1.1, 0.3, -0.2}, {0.2, -0.3, 0.8, 4}}};
  return camera;
}

std::array<double, 4> product(const Matrix4& m, const std::array<double, 4>& p) {
  std::array<double, 4> result{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) result[r] += m[4 * r + k] * p[k];
  }
  return result;
}

class OddCamera : public testing::TestWithParam<ProjectionModel> {};

TEST_P(OddCamera, RaysAreSeenWhereTheyComeFrom) {
  const Camera camera = odd_camera(GetParam());
  const CameraRays rays = camera_rays(camera);
  const ClipRange range{0.5, 20};
  for (const auto& [u, v, depth] : {std::array{0.0, 0.0, 0.5}, {31.25, 70.5, 3.0}, {160, 90, 20}}) {
    std::array<double, 4> world{0, 0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&, x = u, y = v](const CameraRays::Affine& f) {
        return f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k];
      };
      world[k] = at(rays.origin) + depth * at(rays.direction);
    }
    const auto& row = camera.world_to_camera[2];
    EXPECT_NEAR(row[0] * world[0] + row[1] * world[1] + row[2] * world[2] + row[3], depth, 1e-12);

    const auto eye = product(eye_from_world(camera), world);
    EXPECT_NEAR(eye[2], -depth, 1e-12);
    const auto clip = product(clip_from_eye(camera, range), eye);
    EXPECT_NEAR(clip[0] / clip[3], 2 * u / 160 - 1, 1e-12);
    EXPECT_NEAR(clip[1] / clip[3], 1 - 2 * v / 90, 1e-12);
    const auto reversed = product(clip_from_eye(camera, range, ClipDepth::one_to_zero), eye);
    EXPECT_NEAR(reversed[2] / reversed[3], (1 - clip[2] / clip[3]) / 2, 1e-12);
    if (depth == range.near || depth == range.far) {
      EXPECT_NEAR(clip[2] / clip[3], depth == range.near ? -1 : 1, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, OddCamera,
                         testing::Values(ProjectionModel::perspective,
                                         ProjectionModel::orthographic),
                         [](const auto& projection) {
                           return projection.param == ProjectionModel::perspective ? "Perspective"
                                                                                   : "Orthographic";
                         });

TEST(ClipRange, IsTheCamerasOrJustOutsideTheCorners) {
  Camera camera{.width = 4, .height = 4, .near = 0.25, .far = 9};
  WorldMesh mesh;
  mesh.points = {{0, 0, 2}, {0, 1, 5}, {1, 0, -3}};
  EXPECT_EQ(clip_range(mesh, camera).near, 0.25);
  EXPECT_EQ(clip_range(mesh, camera).far, 9);
  camera.near = 0;
  camera.far = std::numeric_limits<double>::infinity();
  const ClipRange around = clip_range(mesh, camera);
  EXPECT_NEAR(around.near, 2 * 0.999, 1e-12);
  EXPECT_NEAR(around.far, 5 * 1.001, 1e-12);
  mesh.points.push_back({0, 0, 1e-9});
  EXPECT_NEAR(clip_range(mesh, camera).near, 5 * 1.001e-4, 1e-12);
}

}  // namespace
}  // namespace fathom::attribution
