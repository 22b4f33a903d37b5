#include "fathom/attribution/model/sample_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fathom::attribution {
namespace {

struct Point {
  double x, y;
};

/// As OpenCV distorts a point of the plane at depth 1.
Point distorted(double x, double y, double k1, double k2) {
  const double square = x * x + y * y;
  const double factor = 1 + k1 * square + k2 * square * square;
  return {factor * x, factor * y};
}

Camera skewed_camera() {
  Camera camera{.width = 60, .height = 40};
  camera.projection.fx = 50;
  camera.projection.fy = 55;
  camera.projection.cx = 27.5;
  camera.projection.cy = 21;
  camera.projection.skew = 3;
  camera.projection.pixel_centre = 0;
  return camera;
}

TEST(Undistorted, IsTheInverseOfTheForwardFormula) {
  for (const auto& [k1, k2] :
       {std::array{0.1, 0.0}, {-0.1, 0.0}, {0.0, 0.05}, {-0.2, 0.1}, {1e-9, 0.0}, {0.8, -0.02}}) {
    for (double x = -0.8; x <= 0.8; x += 0.1) {
      for (const double y : {-0.6, -0.05, 0.0, 0.3, 0.7}) {
        const auto [ideal_x, ideal_y] = undistorted(x, y, k1, k2);
        const Point shown = distorted(ideal_x, ideal_y, k1, k2);
        EXPECT_NEAR(shown.x, x, 1e-14) << k1 << " " << k2;
        EXPECT_NEAR(shown.y, y, 1e-14) << k1 << " " << k2;
        if (x == 0 && y == 0) {
          EXPECT_EQ(ideal_x, 0);
        }
      }
    }
  }
}

TEST(Undistorted, ABarrelIsSeenCloserToTheCentreThanItIs) {
  EXPECT_GT(undistorted(0.5, 0, -0.1, 0)[0], 0.5);
  EXPECT_LT(undistorted(0.5, 0, 0.1, 0)[0], 0.5);
}

TEST(SampleGrid, WithoutDistortionNothingIsRounded) {
  const SampleGrid grid(skewed_camera(), {.x = 0.1, .y = 0.7});
  EXPECT_EQ(grid.at(17, 3)[0], 17 + 0.1);
  EXPECT_EQ(grid.at(17, 3)[1], 3 + 0.7);
  EXPECT_EQ(grid.reach(), 0);
}

// From the ideal position through the plane at depth 1 and the lens back to the sample.
TEST(SampleGrid, TheLensShowsTheSampleThere) {
  const Camera camera = skewed_camera();
  for (const double k1 : {0.15, -0.15}) {
    const SamplePosition sample{.x = 0.25, .y = 0.75, .k1 = k1, .k2 = -k1 / 3};
    const SampleGrid grid(camera, sample);
    const double centre_x = camera.projection.cx + 0.5,
                 centre_y = camera.projection.cy + 0.5;  // pixel_centre is 0
    for (std::uint32_t row = 0; row < camera.height; ++row) {
      for (std::uint32_t column = 0; column < camera.width; ++column) {
        const auto [u, v] = grid.at(column, row);
        const double y = (v - centre_y) / camera.projection.fy;
        const double x = (u - centre_x - camera.projection.skew * y) / camera.projection.fx;
        const Point shown = distorted(x, y, sample.k1, sample.k2);
        ASSERT_NEAR(camera.projection.fx * shown.x + camera.projection.skew * shown.y + centre_x,
                    column + 0.25, 1e-11);
        ASSERT_NEAR(camera.projection.fy * shown.y + centre_y, row + 0.75, 1e-11);
        ASSERT_LE(std::abs(u - column - 0.25), grid.reach());
        ASSERT_LE(std::abs(v - row - 0.75), grid.reach());
      }
    }
    EXPECT_GT(grid.reach(), 1);
    EXPECT_LT(grid.reach(), 8);
  }
}

}  // namespace
}  // namespace fathom::attribution
