// The model of Cycles' rays: its formulas in binary32, written anew here,
// stay within the bounds, and the bounds contain the exact rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

#include "fathom/lens/preimages.h"
#include "validation/blender/blender_panorama.h"
#include "validation/lenses/lens_cases.h"
#include "validation/lenses/lens_judge.h"

namespace fathom::validation {
namespace {

constexpr std::uint32_t width = 48, height = 32;

Camera panorama_named(const std::string& name) {
  const auto all = blender_panoramas(width, height);
  return *std::ranges::find(all, name, &Camera::name);
}

TEST(BlenderPanoramas, AreRecognized) {
  using Type = BlenderPanorama::Type;
  const Type types[] = {Type::equirectangular, Type::mirror_ball, Type::fisheye_equidistant,
                        Type::fisheye_equisolid};
  const auto cameras = blender_panoramas(width, height);
  ASSERT_EQ(cameras.size(), std::size(types));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto panorama = panorama_of(cameras[i]);
    ASSERT_TRUE(panorama) << cameras[i].name;
    EXPECT_EQ(panorama->type, types[i]);
  }
  EXPECT_EQ(panorama_of(panorama_named("equisolid"))->lens, 10.5);
  Camera moved = panorama_named("equidistant");
  moved.projection.cx += 1;
  EXPECT_FALSE(panorama_of(moved));
  for (const Camera& lens : lens_cameras(width, height)) EXPECT_FALSE(panorama_of(lens));
  EXPECT_FALSE(panorama_of(Camera{.width = 4, .height = 4}));
}

/// The exact direction of each pixel, of any length, against the middle of the model's ray: they
/// differ by no more than two roundings, far less than the bounds, which have to contain binary32.
TEST(CyclesRays, FollowTheExactRays) {
  for (const Camera& camera : blender_panoramas(width, height)) {
    const lens::Preimages preimages(camera.projection, *camera.projection.lens);
    const auto made = cycles_rays(camera, 0);
    ASSERT_EQ(made.rays.size(), std::size_t{width} * height);
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel) {
      const auto d = preimages.of_pixel(pixel % width, pixel / width);
      const auto& ray = made.rays[pixel];
      ASSERT_EQ(d.has_value(), ray.direction != (std::array<double, 3>{}))
          << camera.name << ' ' << pixel;
      if (!d) continue;
      std::array<double, 3> exact{};
      for (std::size_t k = 0; k < 3; ++k) exact[k] = d->box()[k].lower / 2 + d->box()[k].upper / 2;
      const double length = std::hypot(exact[0], exact[1], exact[2]);
      for (std::size_t k = 0; k < 3; ++k) {
        // constants such as π are rounded to binary32 by the program, not in the middle
        EXPECT_NEAR(exact[k] / length, ray.direction[k], 1e-12) << camera.name << ' ' << pixel;
        EXPECT_GT(ray.error[k], 0);
        EXPECT_LT(ray.error[k], 1e-4);
      }
    }
  }
}

/// Cycles' fisheye in binary32, with acosf.
std::array<float, 3> fisheye_in_binary32(std::uint32_t column, std::uint32_t row, float fov) {
  const float u = (static_cast<float>(column) + 0.5F) * (1.0F / width),
              v = (static_cast<float>(height - 1 - row) + 0.5F) * (1.0F / height);
  const float x = (u - 0.5F) * 2.0F, y = (v - 0.5F) * 2.0F;
  const float r = std::sqrt(x * x + y * y);
  float phi = std::acos(std::clamp(x / r, -1.0F, 1.0F));
  if (y < 0) phi = -phi;
  const float theta = r * fov * 0.5F;
  return {std::cos(phi) * std::sin(theta), -std::sin(phi) * std::sin(theta), std::cos(theta)};
}

TEST(CyclesRays, BoundItsArithmeticAndTheStepsOfAcosf) {
  const Camera camera = panorama_named("equidistant");
  const auto fov = static_cast<float>(panorama_of(camera)->fov);
  const auto wide = cycles_rays(camera, 0), narrow = cycles_rays(camera, 0, CyclesAzimuth::exact);
  double used = 0;
  std::size_t beyond_narrow = 0;
  for (std::uint32_t pixel = 0; pixel < width * height; ++pixel) {
    const auto& ray = wide.rays[pixel];
    if (ray.direction == std::array<double, 3>{}) continue;
    const auto own = fisheye_in_binary32(pixel % width, pixel / width, fov);
    bool is_beyond = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double off = std::abs(own[k] - ray.direction[k]);
      EXPECT_LE(off, ray.error[k]) << pixel;
      used = std::max(used, off / ray.error[k]);
      is_beyond = is_beyond || off > narrow.rays[pixel].error[k];
    }
    if (is_beyond) ++beyond_narrow;
  }
  EXPECT_GT(used, 0.1);
  EXPECT_GT(beyond_narrow, 0U);
}

/// A perfect map is explained, and a map whose samples lie elsewhere is not.
TEST(CyclesJudge, ExplainsExactMapsOnly) {
  for (const Camera& camera : blender_panoramas(width, height)) {
    const auto scene = make_validation_scene("slivers", width, height);
    const LensCase given = lens_case(scene, camera);
    const auto map_of = [&](const LensCase& drawn) {
      return attribution::OtherMap{.width = width, .height = height, .depths = drawn.truth.depths};
    };
    const JudgedLens judged = judge_cycles(given, map_of(given));
    EXPECT_EQ(judged.unexplained(), 0U) << camera.name;
    EXPECT_EQ(judged.by_acos, 0U);
    EXPECT_LT(judged.attribution.sharpness.median_relative_width, 3e-4) << camera.name;
    Camera moved = camera;
    moved.projection.cx += 0.1;
    const JudgedLens off = judge_cycles(given, map_of(lens_case(scene, moved)));
    EXPECT_GT(off.unexplained(), off.attribution.errors.pixels / 4 + 5) << camera.name;
  }
}

}  // namespace
}  // namespace fathom::validation
