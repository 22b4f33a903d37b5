#include "fathom/attribution/faults/shift_estimate.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

namespace fathom::attribution {
namespace {

/// Two planes side by side, as a renderer sees them whose samples lie (dx, dy) from the centres.
struct Planes {
  Truth truth;
  OtherMap other;

  Planes(Projection projection, double dx, double dy) {
    truth.camera = {.width = 24, .height = 16, .projection = projection};
    other = {.width = 24, .height = 16};
    const bool perspective = projection == Projection::perspective;
    for (std::uint32_t row = 0; row < 16; ++row) {
      for (std::uint32_t column = 0; column < 24; ++column) {
        const std::uint32_t plane = column < 12 ? 0 : 1;
        const auto depth = [&](double x, double y) {
          const double affine = plane == 0 ? 2 + 0.01 * x + 0.002 * y : 3 - 0.004 * x + 0.02 * y;
          return perspective ? 1 / affine : affine;
        };
        truth.triangles.push_back(plane);
        truth.depths.push_back(depth(column, row));
        other.depths.push_back(depth(column + dx, row + dy));
      }
    }
  }
};

TEST(ShiftEstimate, FindsAShift) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Planes planes(projection, 0.25, -0.125);
    const auto shift = estimated_shift(planes.truth, planes.other);
    ASSERT_TRUE(shift);
    EXPECT_NEAR(shift->x, 0.25, 1e-9);
    EXPECT_NEAR(shift->y, -0.125, 1e-9);
  }
}

TEST(ShiftEstimate, PixelsThatShowSomethingElseDoNotMatter) {
  Planes planes(Projection::orthographic, 0.25, -0.125);
  planes.other.depths[40] = 5;
  planes.other.depths[200] = std::numeric_limits<double>::infinity();
  const auto shift = estimated_shift(planes.truth, planes.other);
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->x, 0.25, 1e-9);
  EXPECT_NEAR(shift->y, -0.125, 1e-9);
}

TEST(ShiftEstimate, IsNothingWhereDepthsDoNotTell) {
  Planes planes(Projection::orthographic, 0, 0);
  for (double& depth : planes.truth.depths) depth = 2;
  EXPECT_FALSE(estimated_shift(planes.truth, planes.other));
  const Planes far_off(Projection::orthographic, 5, 0);
  EXPECT_FALSE(estimated_shift(far_off.truth, far_off.other));
}

}  // namespace
}  // namespace fathom::attribution
