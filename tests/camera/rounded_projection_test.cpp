// Projections in binary64, held to the exact ones; and what else follows from a projection alone.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/camera/camera.h"
#include "fathom/camera/projection.h"
#include "fathom/numeric/rounding.h"

namespace fathom {
namespace {

Projection some_projection(ProjectionModel model) {
  return {.model = model,
          .fx = 150,
          .fy = -130,
          .cx = 70.25,
          .cy = 48.5,
          .skew = 12,
          .pixel_centre = 0};
}

double quotient_of(const Dyadic& a, const Dyadic& b) {
  return round_to_binary64(Ratio(a, b));
}

class Rounded : public testing::TestWithParam<ProjectionModel> {};

TEST_P(Rounded, ImagesAreThoseOfTheExactProjection) {
  const Projection projection = some_projection(GetParam());
  const RoundedProjection rounded(projection);
  std::mt19937 random(7);  // NOLINT: the same numbers each time
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const std::array<double, 3> p{draw(random), draw(random), 2 + draw(random)};
    const auto [u, v] = rounded.image_of(p);
    const auto [U, V, W] = to_image(projection, CameraPoint{p[0], p[1], p[2]});
    ASSERT_NEAR(u, quotient_of(U, W), 1e-12);
    ASSERT_NEAR(v, quotient_of(V, W), 1e-12);
  }
}

TEST_P(Rounded, PointsOfThePlaneAreTheWayBack) {
  const RoundedProjection rounded(some_projection(GetParam()));
  for (const double u : {0.0, 31.5, 160.0}) {
    for (const double v : {-3.0, 17.25, 90.0}) {
      const auto [x, y] = rounded.plane_point_at(u, v);
      const auto back = rounded.image_of({x, y, 1});
      EXPECT_NEAR(back[0], u, 1e-12);
      EXPECT_NEAR(back[1], v, 1e-12);
    }
  }
}

// x = 2u/width − 1 and y = 1 − 2v/height of the image of every point.
TEST_P(Rounded, ClipRowsLeadToDeviceCoordinates) {
  const Projection projection = some_projection(GetParam());
  const RoundedProjection rounded(projection);
  const auto [xx, xy, x1, yy, y1] = rounded.clip_rows(160, 90);
  const std::array<double, 3> p{0.5, -0.25, 1.75};
  const auto [u, v] = rounded.image_of(p);
  const double w = is_perspective(projection) ? p[2] : 1;
  EXPECT_NEAR((xx * p[0] + xy * p[1] + x1 * w) / w, 2 * u / 160 - 1, 1e-13);
  EXPECT_NEAR((yy * p[1] + y1 * w) / w, 1 - 2 * v / 90, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Projections, Rounded,
                         testing::Values(ProjectionModel::perspective,
                                         ProjectionModel::orthographic),
                         [](const auto& model) {
                           return model.param == ProjectionModel::perspective ? "Perspective"
                                                                              : "Orthographic";
                         });

TEST(Projections, AreMirroredWhereFocalLengthsDifferInSign) {
  EXPECT_FALSE(is_mirrored({.fx = 2, .fy = 3}));
  EXPECT_FALSE(is_mirrored({.fx = -2, .fy = -3}));
  EXPECT_TRUE(is_mirrored({.fx = -2, .fy = 3}));
  EXPECT_TRUE(is_mirrored({.fx = 2, .fy = -3}));
}

TEST(Projections, DifferInEveryNumber) {
  const Projection projection = some_projection(ProjectionModel::perspective);
  Projection other = projection;
  EXPECT_EQ(other, projection);
  other.model = ProjectionModel::orthographic;
  EXPECT_NE(other, projection);
  for (double Projection::*number :
       {&Projection::fx, &Projection::fy, &Projection::cx, &Projection::cy, &Projection::skew,
        &Projection::pixel_centre}) {
    other = projection;
    other.*number += 1;
    EXPECT_NE(other, projection);
  }
}

}  // namespace
}  // namespace fathom
