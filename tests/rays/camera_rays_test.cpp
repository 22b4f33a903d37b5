#include <gtest/gtest.h>

#include <random>

#include "fathom/rays/cast.h"
#include "fathom/rays/hit_values.h"
#include "fathom/render.h"
#include "tests/inputs/scene_building.h"

namespace fathom::rays {
namespace {

/// Triangles of all sizes in front of the origin; no ray of the cameras below meets an edge.
Scene some_scene() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-3, 3), offset(-1, 1), depth(2, 9);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const double x = place(random), y = place(random), z = depth(random);
    for (int k = 0; k < 3; ++k) {
      const double dx = offset(random), dy = offset(random), dz = offset(random);
      vertices.push_back({x + dx, y + dy, z + dz});
    }
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Scene scene = checks::scene_of(std::move(vertices), std::move(triangles));
  scene.objects.push_back(scene.objects[0]);
  Object& placed = scene.objects.back();
  placed.placed_as_is = false;
  placed.world_from_mesh.rows = {
      {{0.5, 0.1, 0.0, 0.3}, {-0.1, 0.6, 0.0, 0.1}, {0.0, 0.2, 0.7, 1.0}}};
  return scene;
}

/// Whose focal length is a power of two, so that the rays of its pixels are binary64 numbers.
Camera some_camera(ProjectionModel model) {
  Camera camera = checks::camera_of(96, 64, model == ProjectionModel::perspective ? 64 : 16);
  camera.projection.model = model;
  camera.world_to_camera[0][3] = 0.375;
  camera.world_to_camera[1][3] = -0.25;
  camera.world_to_camera[2][3] = 1.5;
  return camera;
}

/// The points of depth t on the ray of a pixel.
Ray ray_of(const Camera& camera, std::uint32_t column, std::uint32_t row) {
  const Projection& p = camera.projection;
  const double x = (column + 0.5 - p.cx) / p.fx, y = (row + 0.5 - p.cy) / p.fy;
  const auto& pose = camera.world_to_camera;
  if (p.model == ProjectionModel::perspective)
    return {{-pose[0][3], -pose[1][3], -pose[2][3]}, {x, y, 1}};
  return {{x - pose[0][3], y - pose[1][3], -pose[2][3]}, {0, 0, 1}};
}

class CameraRays : public ::testing::TestWithParam<ProjectionModel> {};

TEST_P(CameraRays, MeetWhatPixelsShow) {
  const Scene scene = some_scene();
  const Camera camera = some_camera(GetParam());
  RenderOptions options;
  options.channels = {Channel::Z, Channel::id, Channel::distance,
                      Channel::N, Channel::P,  Channel::bary};
  const DepthMap map = render(scene, camera, options).map;
  std::vector<Ray> rays;
  for (std::uint32_t row = 0; row < camera.height; ++row)
    for (std::uint32_t column = 0; column < camera.width; ++column)
      rays.push_back(ray_of(camera, column, row));
  const auto hits = cast(RayScene(scene), rays);
  int surfaces = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ((*map.values<std::uint32_t>("id"))[i], hits[i].triangle);
    if (hits[i].triangle == no_triangle) continue;
    ++surfaces;
    const auto values = hit_values<float>(scene, rays[i], hits[i].triangle);
    const auto expect = [&](const char* channel, float value) {
      EXPECT_EQ((*map.values<float>(channel))[i], value) << channel;
    };
    expect("Z", values.t);
    expect("distance", values.distance);
    expect("N.X", values.normal[0]);
    expect("N.Y", values.normal[1]);
    expect("N.Z", values.normal[2]);
    expect("P.X", values.position[0]);
    expect("P.Y", values.position[1]);
    expect("P.Z", values.position[2]);
    expect("bary.U", values.barycentric[0]);
    expect("bary.V", values.barycentric[1]);
  }
  EXPECT_GT(surfaces, 3000);
}

INSTANTIATE_TEST_SUITE_P(Models, CameraRays,
                         ::testing::Values(ProjectionModel::perspective,
                                           ProjectionModel::orthographic),
                         [](const auto& model) -> std::string {
                           return model.param == ProjectionModel::perspective ? "Perspective"
                                                                              : "Orthographic";
                         });

}  // namespace
}  // namespace fathom::rays
