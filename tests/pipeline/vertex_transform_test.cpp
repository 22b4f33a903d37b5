// Vertices to the window by the stages, against the exact camera.
#include "fathom/pipeline/geometry/vertex_transform.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/pipeline/geometry/window_transform.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

Camera camera_from(std::mt19937_64& random, bool perspective) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Camera c;
  c.width = 640;
  c.height = 480;
  c.projection.model = perspective ? ProjectionModel::perspective : ProjectionModel::orthographic;
  c.projection.fx = 500 + 100 * unit(random);
  c.projection.fy = 500 + 100 * unit(random);
  c.projection.skew = 10 * unit(random);
  c.projection.cx = 320 + 20 * unit(random);
  c.projection.cy = 240 + 20 * unit(random);
  c.projection.pixel_centre = random() % 2 ? 0.5 : 0;
  c.near = 0.5;
  c.far = 50;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      c.world_to_camera[i][k] = (i == k) + 0.2 * unit(random) + (i == 2 && k == 3 ? 8 : 0);
    }
  }
  return c;
}

/// What a depth is to become; under an orthographic camera depth is affine in any mapping.
double window_depth(const DepthFormat& format, const Dyadic& D, bool perspective) {
  if (perspective) return round_to_binary64(stored_value(format, Ratio(D)));
  const Dyadic near(format.near), far(format.far);
  return round_to_binary64(Ratio(is_reversed(format.mapping) ? far - D : D - near, far - near));
}

/// The window is the image, and its depth what the depth format makes of the exact depth.
TEST(VertexTransform, StagesLeadToTheImageAndToTheStoredDepth) {
  std::mt19937_64 random(241);
  std::uniform_real_distribution<double> side(-2, 2);
  for (int i = 0; i < 400; ++i) {
    const bool perspective = i % 2 == 0;
    const Camera camera = camera_from(random, perspective);
    PipelineOptions options;
    options.precision = Precision::binary64;
    const Mapping mappings[] = {Mapping::standard, Mapping::opengl, Mapping::reversed,
                                Mapping::infinite, Mapping::reversed_infinite};
    options.depth_format.mapping = mappings[i / 2 % (perspective ? 5 : 3)];
    fill_in_range({}, camera, options.depth_format);
    Object object;
    for (auto& row : object.world_from_mesh.rows) {
      for (Dyadic& x : row) x = x + Dyadic(0.1 * side(random));
    }
    object.placed_as_is = false;
    const VertexTransform<double> transform(camera, object, options);
    const Viewport viewport = viewport_of(camera, options);
    const MeshPoint p{side(random), side(random), side(random)};
    const CameraPoint exact = to_camera(camera.world_to_camera, object.world_from_mesh(p));
    const auto [U, V, W] = to_image(camera.projection, exact);
    const double u = round_to_binary64(Ratio(U, W)), v = round_to_binary64(Ratio(V, W));
    InputVertex vertex;
    vertex.position = p;
    const ClipVertex<double> clip = transform(vertex);
    ASSERT_GT(clip.position.w, 0);
    const WindowVertex<double> window = viewport(divide(clip));
    // A few dozen roundings of numbers below 2¹⁰ and of quotients of them by depths above 1.
    EXPECT_NEAR(window.x, u, 1e-9);
    EXPECT_NEAR(window.y, v, 1e-9);
    EXPECT_NEAR(window.attributes[attribute::depth], round_to_binary64(exact.z), 1e-12);
    EXPECT_NEAR(window.z, window_depth(options.depth_format, exact.z, perspective), 1e-11);
    const EyeVertex<double> eye = transform.to_eye(transform.to_world(p));
    EXPECT_NEAR(eye.z, -round_to_binary64(exact.z), 1e-12);
    EXPECT_NEAR(eye.y, -round_to_binary64(exact.y), 1e-12);
  }
}

TEST(VertexTransform, VolumesAndFragmentsOfMappings) {
  EXPECT_EQ(volume_of(Mapping::opengl), clipping::Volume::opengl);
  EXPECT_EQ(volume_of(Mapping::reversed), clipping::Volume::zero_one);
  EXPECT_FALSE(is_per_fragment(Mapping::infinite));
  EXPECT_TRUE(is_per_fragment(Mapping::log));
}

TEST(FillInRange, HoldsTheSceneWhereTheCameraHasNone) {
  const Scene scene = checks::scene_of({{0, 0, 2}, {1, 0, 3}, {0, 1, 8}}, {{0, 1, 2}});
  Camera camera = checks::camera_of(8, 8, 4);
  DepthFormat format{Mapping::standard, Storage::float32, 0, 0, 1};
  fill_in_range(scene, camera, format);
  EXPECT_EQ(format.near, 1);
  EXPECT_EQ(format.far, 16);
  camera.near = 0.25;
  camera.far = 4;
  format.near = format.far = 0;
  fill_in_range(scene, camera, format);
  EXPECT_EQ(format.near, 0.25);
  EXPECT_EQ(format.far, 4);
  // Behind the eye too: 10⁻⁴ of the greatest depth.
  const Scene around = checks::scene_of({{0, 0, -2}, {1, 0, 3}, {0, 1, 8}}, {{0, 1, 2}});
  camera.near = 0;
  format.near = format.far = 0;
  fill_in_range(around, camera, format);
  EXPECT_DOUBLE_EQ(format.near, 8e-4);
  camera.projection.model = ProjectionModel::orthographic;
  format = {Mapping::infinite, Storage::float32, 0, 0, 1};
  EXPECT_THROW(fill_in_range(scene, camera, format), UsageError);
}

}  // namespace
}  // namespace fathom::pipeline
