// A point on the ray of a sample is seen there, at the depth it was taken at: through the forward
// transform of camera and placement, in exact numbers.
#include "fathom/triangle/rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/inputs/scene_building.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::Numbers;

Camera skewed_camera(Numbers& n, bool perspective) {
  Camera c = checks::camera_of(640, 480, 0);
  c.projection.model = perspective ? ProjectionModel::perspective : ProjectionModel::orthographic;
  c.projection.fx = 400 * (1 + n.unit() / 2);
  c.projection.fy = (n.below(2) ? 1 : -1) * 400 * (1 + n.unit() / 2);
  c.projection.skew = n.below(2) ? n.unit() * 20 : 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      c.world_to_camera[i][k] = (i == k) + 0.4 * n.unit() + (i == 2 && k == 3 ? 4 : 0);
    }
  }
  return c;
}

Object object_from(Numbers& n, bool placed) {
  Object object;
  if (!placed) return object;
  object.placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      object.world_from_mesh.rows[i][k] = Dyadic((i == k) + 0.3 * n.unit());
    }
  }
  return object;
}

Dyadic exact_pair(const WordPair& x) {
  return Dyadic(x.hi) + Dyadic(x.lo);
}

struct ExactPoint {
  Dyadic x, y, z;
};

/// The point of depth D on the ray of (u, v), as Rays says.
ExactPoint point_on(const Rays& rays, bool perspective, double u, double v, double D) {
  const Dyadic factors[4] = {perspective ? Dyadic(D) * Dyadic(u) : Dyadic(u),
                             perspective ? Dyadic(D) * Dyadic(v) : Dyadic(v), Dyadic(D), 1.0};
  std::array<Dyadic, 3> p;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < 3; ++k) p[k] += exact_pair(rays.columns[j][k]) * factors[j];
  }
  return {p[0], p[1], p[2]};
}

class RaysOf : public ::testing::TestWithParam<std::tuple<bool, bool>> {};

TEST_P(RaysOf, PointsAreSeenWhereTheyWereTaken) {
  const auto [perspective, placed] = GetParam();
  Numbers n(101);
  for (int i = 0; i < 300; ++i) {
    const Camera camera = skewed_camera(n, perspective);
    const Object object = object_from(n, placed);
    const ObjectRays rays(object, camera);
    ASSERT_TRUE(rays.usable);
    EXPECT_EQ(rays.placed_as_is, !placed);
    const double u = n.below(640) + 0.5, v = n.below(480) + 0.5, D = 1 + std::abs(n.unit()) * 9;
    const ExactPoint X = point_on(rays.rays, perspective, u, v, D);
    const CameraPoint p = to_camera(camera.world_to_camera, object.world_from_mesh.apply(X));
    const HomogeneousImagePoint seen = to_image(camera.projection, p);
    // Entries err by 2⁻¹⁰⁶ of themselves; terms and what the transform makes of them stay below
    // 2¹⁰ each in the camera frame and 2²⁰ on the image.
    const auto expect_near = [](const Dyadic& found, const Dyadic& expected) {
      const Dyadic difference = found - expected;
      EXPECT_LT(compare(difference, Dyadic(0x1p-80)), 0);
      EXPECT_GT(compare(difference, Dyadic(-0x1p-80)), 0);
    };
    expect_near(p.z, Dyadic(D));
    expect_near(seen.U, Dyadic(u) * seen.W);
    expect_near(seen.V, Dyadic(v) * seen.W);
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, RaysOf, ::testing::Combine(::testing::Bool(), ::testing::Bool()));

TEST(ObjectRays, APlacementThatFlattensIsNotUsable) {
  Numbers n(102);
  const Camera camera = skewed_camera(n, true);
  Object object = object_from(n, true);
  object.world_from_mesh.rows[2] = object.world_from_mesh.rows[1];
  EXPECT_FALSE(ObjectRays(object, camera).usable);
}

/// Values that are double-words, and what their last bits are said to be.
TEST(ExactRow, ValuesAreTheExactOnes) {
  Numbers n(103);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    std::array<Dyadic, 4> coefficients;
    for (Dyadic& c : coefficients) c = Dyadic(i % 2 == 0 ? n.wild(8) : n.below(65) - 32.0);
    const ExactRow row(coefficients);
    const auto coordinate = [&] { return std::ldexp(n.below(1025) - 512, -n.below(12)); };
    const MeshPoint X{coordinate(), coordinate(), coordinate()};
    const Dyadic exact = coefficients[0] * Dyadic(X.x) + coefficients[1] * Dyadic(X.y) +
                         coefficients[2] * Dyadic(X.z) + coefficients[3];
    if (const std::optional<WordPair> value = row.value_at(X)) {
      ++found;
      ASSERT_EQ(exact_pair(*value), exact);
    }
    // 512·2⁻¹¹ at the finest: every coordinate is a multiple of 2⁻¹¹.
    const long bit = row.last_bit_at({-11, -11, -11});
    if (!exact.is_zero()) {
      ASSERT_LE(bit, static_cast<long>(mpz_scan1(exact.significand(), 0)) + exact.exponent());
    }
  }
  EXPECT_GT(found, 1500);
}

/// An entry that is not 0 but rounds to 0 would count as exact.
TEST(Rays, EntriesThatUnderflowAreRefused) {
  const Camera plain = checks::camera_of(16, 12, 8);
  ASSERT_TRUE(ObjectRays({}, plain).usable);
  Camera centre = plain;  // at (−5·10⁻³²⁴/4, 0, 0)
  centre.world_to_camera = {{{4, 0, 0, 0x1p-1074}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  EXPECT_FALSE(ObjectRays({}, centre).usable);
  Camera direction = plain;  // m₀ is tilted by 2⁻¹⁰⁷⁸
  direction.world_to_camera = {{{1, 0, 0, 0}, {0x1p-1074, 0, 1, 0}, {0, 1, 0, 0}}};
  EXPECT_FALSE(ObjectRays({}, direction).usable);
  Object object;  // a cofactor of the placement is 2⁻¹⁰⁷⁶
  object.placed_as_is = false;
  object.world_from_mesh.rows = {
      {{0.25, 0.0, 0.0, 0.0}, {0.0, 0x1p-1074, 2.0, 0.0}, {0.0, 2.0, 0.0, 8.0}}};
  EXPECT_FALSE(ObjectRays(object, plain).usable);
}

}  // namespace
}  // namespace fathom
