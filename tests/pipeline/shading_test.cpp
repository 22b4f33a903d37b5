#include "fathom/pipeline/fragments/shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

TEST(Lighting, IsThatOfTheHandbooks) {
  // Light and eye on the z axis, the surface facing them: all light there is.
  Lighting lighting{{0, 0, 1}, {0, 0, 5}, false};
  const Light straight = light_at(lighting, {0, 0, 0}, {0, 0, 2});
  EXPECT_DOUBLE_EQ(straight.diffuse, 0.15 + 0.75);
  EXPECT_DOUBLE_EQ(straight.specular, 0.25);
  // The other side is lit the same: the normal is turned towards the eye.
  const Light turned = light_at(lighting, {0, 0, 0}, {0, 0, -3});
  EXPECT_DOUBLE_EQ(turned.diffuse, straight.diffuse);
  // At 60°: half of the diffuse light; the halfway vector is at 60° too, cos⁴⁰ is next to nothing.
  const Light slanted = light_at(lighting, {0, 0, 0}, {std::sqrt(0.75), 0, 0.5});
  EXPECT_NEAR(slanted.diffuse, 0.15 + 0.375, 1e-15);
  EXPECT_NEAR(slanted.specular, 0.25 * std::pow(0.5, 40), 1e-25);
  // Seen from the side, facing the eye, with the light from behind: ambient light alone.
  lighting.eye = {5, 0, 0};
  lighting.towards_light = {-1, 0, 0};
  EXPECT_DOUBLE_EQ(light_at(lighting, {0, 0, 0}, {1, 0, 0}).diffuse, 0.15);
}

TEST(Lighting, OfACamera) {
  Camera camera = testing::camera_of(8, 8, 4);
  camera.world_to_camera[2][3] = 3;  // the eye at z = −3
  const Lighting lighting = lighting_of(camera);
  EXPECT_FALSE(lighting.orthographic);
  EXPECT_NEAR(lighting.eye[2], -3, 1e-12);
  const auto& L = lighting.towards_light;
  EXPECT_NEAR(std::hypot(L[0], L[1], L[2]), 1, 1e-15);
  EXPECT_LT(L[2], 0);  // from the camera's side
  EXPECT_LT(L[1], 0);  // above: y points down
  EXPECT_LT(L[0], 0);  // left
}

}  // namespace
}  // namespace fathom::pipeline
