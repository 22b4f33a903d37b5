#include "validation/colour/expected_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/pipeline/render_pipeline.h"
#include "tests/inputs/scene_building.h"
#include "validation/colour/colour_comparison.h"

/// What `fathom validate --colour` expects, by hand, and beside the pipeline; no other renderer is
/// needed.
namespace fathom::validation {
namespace {

using pipeline::Shading;

constexpr std::uint32_t size = 32;

Camera camera() {
  Camera camera = checks::camera_of(size, size, 16);
  camera.near = 1;
  camera.far = 100;
  return camera;
}

/// One triangle that faces the camera at depth 8, with its lower left, lower right and upper left
/// corner at (2, 30), (30, 30) and (2, 2) in pixels.
LitScene wall(const std::array<double, 3>& normal) {
  LitScene scene;
  const auto seen_at = [](double x, double y) -> std::array<double, 3> {
    return {(x - 16) / 2, (y - 16) / 2, 8};
  };
  scene.triangles = {{.corners = {seen_at(2, 30), seen_at(30, 30), seen_at(2, 2)},
                      .normals = {normal, normal, normal}}};
  scene.camera = camera();
  scene.towards_light = {0, 0, -1};
  scene.material = {.ambient = 0.25, .diffuse = 0.5, .specular = 0, .shininess = 1};
  return scene;
}

constexpr std::array models{LightModel::interpolated_normal, LightModel::derived_normal,
                            LightModel::face, LightModel::corners};

TEST(ExpectedColour, OfAWallByHand) {
  for (const Precision& precision : {binary64_pipeline, vtk_on_llvmpipe}) {
    const LitScene scene = wall({0, 0, -1});
    const ExpectedTriangle triangle(scene.triangles[0], scene, precision);
    // (10, 25) is 8.5 right of and 4.5 above the lower left corner; (20, 11) lies beyond the
    // hypotenuse; (20, 20), whose centre is on it, may be either.
    EXPECT_EQ(triangle.coverage(10, 25), ExpectedTriangle::Coverage::certain);
    EXPECT_EQ(triangle.coverage(20, 11), ExpectedTriangle::Coverage::none);
    EXPECT_EQ(triangle.coverage(20, 20), ExpectedTriangle::Coverage::possible);
    EXPECT_LE(triangle.inverse_depth(10, 25).lower, 1.0 / 8);
    EXPECT_GE(triangle.inverse_depth(10, 25).upper, 1.0 / 8);
    for (const LightModel model : models) {
      const Interval light = triangle.light(10, 25, model);
      EXPECT_LE(light.lower, 0.75);
      EXPECT_GE(light.upper, 0.75);
      EXPECT_LT(light.upper - light.lower, 0.01);
    }
  }
}

TEST(ExpectedColour, PhongsHighlightByHand) {
  // In pixel (16, 16) the eye is straight before the wall but for half a pixel, and the light at
  // 60° on either side: N·L = 1/2, and the mirrored light is at 60° to the eye: (1/2)² = 1/4.
  LitScene scene = wall({0, 0, -1});
  scene.triangles[0].corners = {{{-8, 8, 8}, {8, 8, 8}, {0, -8, 8}}};
  scene.towards_light = {std::sqrt(0.75), 0, -0.5};
  scene.material = {.ambient = 0, .diffuse = 0.5, .specular = 0.5, .shininess = 2};
  const ExpectedTriangle triangle(scene.triangles[0], scene, vtk_on_llvmpipe);
  const double half = 0.5 / 16, length = std::sqrt(1 + 2 * half * half);
  // L mirrored at N is (−√¾, 0, −1/2); V = (−h, −h, −1)/√(1 + 2h²).
  const double cosine = (std::sqrt(0.75) * half + 0.5) / length;
  const double by_hand = 0.5 * 0.5 + 0.5 * cosine * cosine;
  const Interval light = triangle.light(16, 16, LightModel::interpolated_normal);
  EXPECT_LE(light.lower, by_hand);
  EXPECT_GE(light.upper, by_hand);
  EXPECT_LT(light.upper - light.lower, 1e-3);
}

TEST(ExpectedColour, TheBackTurnsTheNormals) {
  const std::array<double, 3> away{std::sqrt(0.75), 0, 0.5};  // leans away from the eye
  LitScene scene = wall(away);
  scene.towards_light = away;
  const auto light = [&] {
    const ExpectedTriangle triangle(scene.triangles[0], scene, binary64_pipeline);
    return triangle.light(10, 25, LightModel::interpolated_normal);
  };
  EXPECT_NEAR(light().lower, 0.75, 1e-4);
  std::swap(scene.triangles[0].corners[1], scene.triangles[0].corners[2]);
  EXPECT_NEAR(light().upper, 0.25, 1e-4);
}

TEST(ExpectedColour, CodesAreRoundedToNearest) {
  const auto codes = [](double lower, double upper) {
    const Codes c = codes_of({lower, upper});
    return std::array{c.least, c.greatest};
  };
  using Pair = std::array<int, 2>;
  EXPECT_EQ(codes(0.5, 0.5), (Pair{127, 128}));  // 127.5: either
  EXPECT_EQ(codes(100.2 / 255, 100.4 / 255), (Pair{100, 100}));
  EXPECT_EQ(codes(100.4 / 255, 101.6 / 255), (Pair{100, 102}));
  EXPECT_EQ(codes(0, 1), (Pair{0, 255}));
}

/// A shallow pyramid of eight sides, whose normals are those of a ball.
LitScene pyramid() {
  Scene scene = checks::scene_of({{0, 0, 6}}, {});
  for (std::uint32_t k = 0; k < 8; ++k) {
    const double angle = std::acos(-1.0) * (k + 0.1) / 4;
    scene.meshes[0].vertices.push_back({5 * std::cos(angle), -5 * std::sin(angle), 8});
    scene.meshes[0].triangles.push_back({0, k + 1, (k + 1) % 8 + 1});
  }
  scene.meshes[0].face_count = 8;
  return lit_scene(scene, camera(),
                   {.ambient = 0.15,
                    .diffuse = 0.6,
                    .specular = 0.25,
                    .shininess = 40,
                    .highlight = pipeline::SpecularModel::phong});
}

GreyPicture drawn(const LitScene& lit, Shading shading) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = shading;
  options.material = lit.material;
  options.light = {.towards = lit.towards_light, .in_world = true};
  const auto frame = render_frame(as_scene(lit), lit.camera, options, true);
  GreyPicture picture{lit.camera.width, lit.camera.height, {}, {}};
  for (const Rgb& c : to_rgb(frame.picture).pixels) picture.codes.push_back(c[0]);
  return picture;
}

std::size_t unexplained(const LitScene& lit, const GreyPicture& picture, LightModel model) {
  const Drawn drawing{&picture, model, binary64_pipeline};
  const ColourComparison found = compare_colours(lit, drawing, drawing);
  EXPECT_GT(found.inside + found.unexplained.size(), 250U);
  EXPECT_LT(found.edge, 100U);
  EXPECT_EQ(found.background + found.inside + found.edge + found.unexplained.size(),
            std::size_t{size} * size);
  if (found.unexplained.empty()) {
    EXPECT_LE(found.mean_bound, 1);
  }
  return found.unexplained.size();
}

// And no picture is taken for one that is lit in another way, or from elsewhere.
TEST(ExpectedColour, ExplainsThePipelinesPicturesAndNoOthers) {
  const LitScene lit = pyramid();
  const GreyPicture flat = drawn(lit, Shading::flat), gouraud = drawn(lit, Shading::gouraud),
                    phong = drawn(lit, Shading::phong);
  EXPECT_EQ(unexplained(lit, flat, LightModel::face), 0U);
  EXPECT_EQ(unexplained(lit, gouraud, LightModel::corners), 0U);
  EXPECT_EQ(unexplained(lit, phong, LightModel::interpolated_normal), 0U);
  EXPECT_GT(unexplained(lit, gouraud, LightModel::interpolated_normal), 20U);
  EXPECT_GT(unexplained(lit, phong, LightModel::corners), 20U);
  EXPECT_GT(unexplained(lit, phong, LightModel::face), 100U);
  EXPECT_GT(unexplained(lit, flat, LightModel::interpolated_normal), 100U);

  LitScene from_elsewhere = lit;
  from_elsewhere.towards_light = {0.6, 0, -0.8};
  EXPECT_GT(
      unexplained(lit, drawn(from_elsewhere, Shading::phong), LightModel::interpolated_normal),
      100U);
  LitScene blinn = lit;
  blinn.material.highlight = pipeline::SpecularModel::blinn;
  EXPECT_GT(unexplained(lit, drawn(blinn, Shading::phong), LightModel::interpolated_normal), 20U);
  // One code more, where the bound leaves one or two.
  GreyPicture brighter = phong;
  for (std::uint8_t& code : brighter.codes) code = static_cast<std::uint8_t>(code + (code > 0));
  EXPECT_GT(unexplained(lit, brighter, LightModel::interpolated_normal), 200U);
}

TEST(LitScene, RefusesWhatBoundsDoNotKnow) {
  const Scene scene = checks::scene_of({{0, 0, 8}, {1, 0, 8}, {0, 1, 8}}, {{0, 1, 2}});
  Camera orthographic = camera();
  orthographic.projection.model = ProjectionModel::orthographic;
  EXPECT_THROW(lit_scene(scene, orthographic, {}), std::exception);
  Camera skewed = camera();
  skewed.world_to_camera[0][0] = 2;
  EXPECT_THROW(lit_scene(scene, skewed, {}), std::exception);
  Camera cutting = camera();
  cutting.near = 9;
  EXPECT_THROW(lit_scene(scene, cutting, {}), std::exception);
  EXPECT_EQ(lit_scene(scene, camera(), {}).triangles.size(), 1U);
}

}  // namespace
}  // namespace fathom::validation
