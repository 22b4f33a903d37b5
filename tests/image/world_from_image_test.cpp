#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/camera/camera_making.h"
#include "fathom/image/files/geotiff.h"
#include "fathom/numeric/ratio.h"

namespace fathom {
namespace {

using image::world_from_image;

/// 40×30 pixels, 8 to the unit, that looks down from z = 10: x to the right, y upwards in the
/// image.
Camera from_above() {
  Camera camera;
  camera.width = 40;
  camera.height = 30;
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.fx = camera.projection.fy = 8;
  camera.projection.cx = 20;
  camera.projection.cy = 15;
  camera.world_to_camera = {{{1, 0, 0, -3}, {0, -1, 0, 7}, {0, 0, -1, 10}}};
  return camera;
}

TEST(WorldFromImage, OnPaper) {
  // The middle of the image, (20, 15), is the point (3, 7) of the world; a pixel is 1/8.
  EXPECT_EQ(world_from_image(from_above()),
            (std::array<double, 6>{3 - 20 / 8.0, 1 / 8.0, 0, 7 + 15 / 8.0, 0, -1 / 8.0}));
  Camera of_opencv = from_above();
  of_opencv.projection.pixel_centre = 0;
  EXPECT_EQ(world_from_image(of_opencv)->at(0), 3 - 20.5 / 8);
}

TEST(WorldFromImage, CamerasThatAreMadeHaveOne) {
  const Camera down = look_at({3, 7, 10}, {3, 7, 0}, {0, 1, 0}, {.width = 4, .height = 4});
  EXPECT_FALSE(world_from_image(down)) << "it is a perspective camera";
  Camera orthographic = from_above();
  orthographic.world_to_camera = down.world_to_camera;
  EXPECT_TRUE(world_from_image(orthographic));
}

TEST(WorldFromImage, OnlyOfAnOrthographicCameraAlongTheWorldsZ) {
  Camera camera = from_above();
  camera.projection.model = ProjectionModel::perspective;
  EXPECT_FALSE(world_from_image(camera));
  for (const int row : {0, 1}) {
    camera = from_above();
    camera.world_to_camera[row][2] = std::numeric_limits<double>::denorm_min();
    EXPECT_FALSE(world_from_image(camera)) << row;
  }
  // What the camera calls depth may lean: x and y of a pixel do not change with it.
  camera = from_above();
  camera.world_to_camera[2][0] = 0.5;
  EXPECT_TRUE(world_from_image(camera));
  // Upwards as well as downwards, and mirrored.
  camera = from_above();
  camera.world_to_camera[2] = {0, 0, 1, 0};
  EXPECT_TRUE(world_from_image(camera));
  // Not a camera at all; and numbers beyond binary64.
  camera.world_to_camera[2][2] = 0;
  EXPECT_FALSE(world_from_image(camera));
  camera = from_above();
  camera.projection.fx = camera.world_to_camera[0][0] = 1e-200;
  EXPECT_FALSE(world_from_image(camera));
}

Ratio absolute(const Ratio& x) {
  return x.sign() == Sign::negative ? Ratio() - x : x;
}

/// No binary64 number is nearer to `exact`.
void expect_nearest(double number, const Ratio& exact) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Ratio error = absolute(Ratio(number) - exact);
  for (const double other : {std::nextafter(number, infinity), std::nextafter(number, -infinity)})
    EXPECT_FALSE(absolute(Ratio(other) - exact) < error)
        << std::hexfloat << number << " or " << other;
}

TEST(WorldFromImage, EveryNumberIsTheExactOneRoundedOnce) {
  std::mt19937_64 random(20261126);
  const auto number = [&] {
    return std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(random),
                      static_cast<int>(random() % 12));
  };
  for (int trial = 0; trial < 300; ++trial) {
    Camera camera = from_above();
    camera.projection.fx = number(), camera.projection.fy = number(),
    camera.projection.skew = number();
    camera.projection.cx = number(), camera.projection.cy = number(),
    camera.projection.pixel_centre = trial % 2 * 0.5;
    auto& r0 = camera.world_to_camera[0];
    auto& r1 = camera.world_to_camera[1];
    r0 = {number(), number(), 0, number()};
    r1 = {number(), number(), 0, number()};
    camera.world_to_camera[2] = {number(), number(), number(), number()};
    const auto g = world_from_image(camera);
    ASSERT_TRUE(g);
    // Camera coordinates of an image point, then x of the first row put into the second.
    const auto world_of = [&](double u, double v) {
      const Ratio shift = Ratio(Dyadic(0.5) - Dyadic(camera.projection.pixel_centre));
      const Ratio b =
          quotient(Ratio(v) - Ratio(camera.projection.cy) - shift, Ratio(camera.projection.fy));
      const Ratio a = quotient(
          Ratio(u) - Ratio(camera.projection.cx) - shift - Ratio(camera.projection.skew) * b,
          Ratio(camera.projection.fx));
      const Ratio p = a - Ratio(r0[3]), q = b - Ratio(r1[3]);
      const Ratio factor = quotient(Ratio(r1[0]), Ratio(r0[0]));
      const Ratio y = quotient(q - factor * p, Ratio(r1[1]) - factor * Ratio(r0[1]));
      const Ratio x = quotient(p - Ratio(r0[1]) * y, Ratio(r0[0]));
      return std::pair(x, y);
    };
    const auto [x0, y0] = world_of(0, 0);
    const auto [xu, yu] = world_of(1, 0);
    const auto [xv, yv] = world_of(0, 1);
    const std::array<Ratio, 6> exact{x0, xu - x0, xv - x0, y0, yu - y0, yv - y0};
    for (std::size_t i = 0; i < 6; ++i) expect_nearest((*g)[i], exact[i]);
  }
}

}  // namespace
}  // namespace fathom
