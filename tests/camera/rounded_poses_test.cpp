#include <gtest/gtest.h>

#include <cmath>

#include "fathom/camera/pose.h"
#include "fathom/numeric/rounding.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace camera;

TEST(Pose, UnitVectorsAreRoundedOnce) {
  EXPECT_EQ(unit_vector({3.0, 0.0, -4.0}), (std::array<double, 3>{0.6, 0, -0.8}));
  EXPECT_EQ(unit_vector({0.0, -1e-300, 0.0}), (std::array<double, 3>{0, -1, 0}));
  // Squares of these overflow; 1/√3 to its last bit.
  const double third = 0x1.279a74590331cp-1;
  EXPECT_EQ(unit_vector({1e300, 1e300, -1e300}), (std::array<double, 3>{third, third, -third}));
}

TEST(Pose, RotationsOfQuaternionsAreRoundedOnce) {
  // A third of a turn around (1, 1, 1), whatever the quaternion's length.
  const Matrix3 third{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(rotation_of({1, 1, 1, 1}), third);
  EXPECT_EQ(rotation_of({1e-200, 1e-200, 1e-200, 1e-200}), third);
  // (w, x, y, z) = (3, 0, 0, 1): cos = 8/10, sin = 6/10 around z.
  const Matrix3 around_z{{{0.8, -0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}}};
  EXPECT_EQ(rotation_of({3, 0, 0, 1}), around_z);
}

/// Rounded to nearest: (e ± ½ ulp)² encloses the exact square vᵢ²/v·v.
TEST(Pose, EntriesOfUnitVectorsAreTheNearest) {
  checks::Numbers n(91);
  for (int i = 0; i < 3000; ++i) {
    const ExactVector3 v{n.unit(), n.unit() * std::ldexp(1, -n.below(40)), n.unit()};
    const std::array<double, 3> unit = unit_vector(v);
    for (int k = 0; k < 3; ++k) {
      const double e = std::abs(unit[k]);
      const auto half_way_to = [&](double other) {
        return (Dyadic(e) + Dyadic(other)) * Dyadic(0.5);
      };
      const Dyadic low = half_way_to(std::nextafter(e, 0));
      const Dyadic high = half_way_to(std::nextafter(e, 2));
      const Dyadic square = v[k] * v[k], length = dot(v, v);
      ASSERT_LE(compare(low * low * length, square), 0);
      ASSERT_GE(compare(high * high * length, square), 0);
      ASSERT_EQ(std::signbit(unit[k]), v[k].sign() == Sign::negative);
    }
  }
}

TEST(Pose, TakesThePointToItsTarget) {
  checks::Numbers n(92);
  for (int i = 0; i < 2000; ++i) {
    Matrix3 R;
    for (auto& row : R) {
      for (double& x : row) x = n.unit();
    }
    const ExactVector3 X{n.unit(), n.unit(), n.unit()};
    const ExactVector3 target{n.unit(), n.unit() * 1e-9, 0.0};
    const Pose pose = pose_that_takes(R, X, target);
    for (int k = 0; k < 3; ++k) {
      const Dyadic rotated =
          Dyadic(R[k][0]) * X[0] + Dyadic(R[k][1]) * X[1] + Dyadic(R[k][2]) * X[2];
      EXPECT_EQ(rotated, rotate(R, X)[k]);
      ASSERT_EQ(pose[k][3], round_to_binary64(Ratio(target[k] - rotated)));
      for (int j = 0; j < 3; ++j) ASSERT_EQ(pose[k][j], R[k][j]);
    }
  }
}

}  // namespace
}  // namespace fathom
