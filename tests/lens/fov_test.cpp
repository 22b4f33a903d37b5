// Directions of FOV against its formula in Arb: samples, signs of forms, ties, and where it ends.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fathom/lens/preimages.h"
#include "tests/effort.h"
#include "tests/lens/expect_direction.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::Direction;
using Point = oracle::OraclePoint<ArbBall>;

ArbBall tangent(const ArbBall& angle) {
  ArbBall result;
  arb_tan(result, angle, ArbBall::bits);
  return result;
}

/// The direction of the specification, divided by ω.
Direction direction_of(double omega, const Point& y) {
  const ArbBall r = (y.x * y.x + y.y * y.y).root(), size(std::abs(omega));
  ArbBall sine, cosine;
  arb_sin_cos(sine, cosine, size * r, ArbBall::bits);
  const ArbBall aside = sine / r / size;
  return {y.x * aside, y.y * aside, ArbBall(2.0) * tangent(size * ArbBall(0.5)) * cosine / size};
}

/// Where Devernay and Faugeras show the direction: r_d = atan(2·r_u·tan(ω/2))/ω.
Point projected(double omega, const Direction& d) {
  const Point u{d[0] / d[2], d[1] / d[2]};
  const ArbBall r = (u.x * u.x + u.y * u.y).root();
  ArbBall angle;
  arb_atan(angle, ArbBall(2.0) * r * tangent(ArbBall(omega) * ArbBall(0.5)), ArbBall::bits);
  const ArbBall factor = angle / ArbBall(omega) / r;
  return {factor * u.x, factor * u.y};
}

Point distorted_point(const Projection& camera, double u, double v) {
  const ArbBall shift = ArbBall(0.5) - ArbBall(camera.pixel_centre);
  const ArbBall y = (ArbBall(v) - ArbBall(camera.cy) - shift) / ArbBall(camera.fy);
  const ArbBall U = ArbBall(u) - ArbBall(camera.cx) - shift;
  return {(U - ArbBall(camera.skew) * y) / ArbBall(camera.fx), y};
}

Lens fov(double omega) {
  return {LensModel::fov, {omega}};
}

std::optional<ExactDirection> ray(double omega, const Dyadic& x, const Dyadic& y) {
  return Preimages({}, fov(omega)).of(x, y);
}

TEST(Fov, SeesWhatTheForwardModelShows) {
  int found = 0, without_ray = 0;
  for (std::uint64_t seed = 0; seed < 60 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    const double omega =
        std::uniform_real_distribution(0.3, 2.5)(random) * (seed % 2 == 0 ? 1 : -1);
    const Projection camera = oracle::random_camera(random);
    const Preimages preimages(camera, fov(omega));
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {300.5, 200.25}, {100.25, 600.75}, {900.5, 12.5}}) {
      const Point y = distorted_point(camera, u, v);
      const double r = (y.x * y.x + y.y * y.y).root().approximate();
      const auto d = preimages.of(u, v);
      ASSERT_EQ(d.has_value(), std::abs(omega) * r < std::numbers::pi / 2) << seed;
      if (!d) {
        ++without_ray;
        continue;
      }
      ++found;
      const Direction exact = direction_of(omega, y);
      const Point image = projected(omega, exact);
      EXPECT_LT(std::abs((image.x - y.x).approximate()), 1e-100);
      EXPECT_LT(std::abs((image.y - y.y).approximate()), 1e-100);
      expect_encloses(*d, exact);
      for (const int offset : {4, 40, 100, 250, 380})
        oracle::expect_signs_of_oracle(*d, exact, offset, random);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort == 1) {
    EXPECT_GT(without_ray, 0);
  }
}

// The plane through the axis and the ray is rational, and no other plane is.
TEST(Fov, TiesInThePlaneOfItsAxis) {
  const Dyadic a = 0.75, b = 1.25, little = Dyadic(1.0).scaled(-3000);
  const ExactDirection d = *ray(1, a, b);
  EXPECT_EQ(d.rational(), nullptr);
  EXPECT_EQ(d.sign_of(ExactVector3{b, -a, 0.0}), Sign::zero);
  EXPECT_EQ(d.sign_of(ExactVector3{b, little - a, 0.0}), Sign::positive);
  EXPECT_EQ(d.sign_of(ExactVector3{b, -a, little}), Sign::positive);
  EXPECT_EQ(d.sign_of(ExactVector3{b, -a, -little}), Sign::negative);
  EXPECT_EQ(d.sign_of(square_of({b, -a, 0.0})), Sign::zero);
  EXPECT_EQ(d.sign_of(QuadraticForm{{0.0, 0.0, 0.0, 0.0, b, -a}}), Sign::zero);
  EXPECT_EQ(d.sign_of(QuadraticForm{{0.0, 0.0, little, 0.0, b, -a}}), Sign::positive);
  EXPECT_EQ(d.sign_of(QuadraticForm{{0.0, 0.0, 0.0, 0.0, b, -little - a}}), Sign::negative);
}

// Where r = ½ the lens changes nothing, whatever ω is: corners and midpoints lie on these rays.
TEST(Fov, TiesOnTheCircleThatItKeeps) {
  Projection camera;
  camera.fx = camera.fy = 10;
  const Dyadic little = Dyadic(1.0).scaled(-3000);
  const ExactVector3 exact{3.0, 4.0, 10.0};
  for (const double omega : {0.1, -0.875, 3.141592653589793, 0x1p-1074}) {
    const Preimages preimages(camera, fov(omega));
    const auto d = preimages.of(3.0, 4.0);
    ASSERT_TRUE(d.has_value());
    for (const ExactVector3& other : {ExactVector3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}) {
      EXPECT_EQ(d->sign_of(cross(exact, other)), Sign::zero);
      EXPECT_EQ(d->sign_of(square_of(cross(exact, other))), Sign::zero);
    }
    // 10·x − 3·z + little·y, and z² − 4·(x² + y²)
    EXPECT_EQ(d->sign_of(ExactVector3{10.0, little, -3.0}), Sign::positive);
    EXPECT_EQ(d->sign_of(QuadraticForm{{-100.0, -100.0, 25.0, 0.0, 0.0, 0.0}}), Sign::zero);
    if (std::abs(omega) < 0.05) continue;
    // Outside of the circle the ray is farther from the axis than the pinhole's.
    const auto beside = preimages.of(Dyadic(3.0) + little, 4.0);
    ASSERT_TRUE(beside.has_value());
    EXPECT_EQ(beside->rational(), nullptr);
    EXPECT_EQ(beside->sign_of(ExactVector3{0.0, 10.0, -4.0}), Sign::positive);
    const auto inside = preimages.of(Dyadic(3.0) - little, 4.0);
    EXPECT_EQ(inside->sign_of(ExactVector3{0.0, 10.0, -4.0}), Sign::negative);
  }
}

TEST(Fov, SeesItsAxisAndThePinholesRaysExactly) {
  for (const double omega : {0.0, -0.0, 1.5}) {
    const auto axis = ray(omega, 0.0, 0.0);
    ASSERT_TRUE(axis && axis->rational() != nullptr);
    EXPECT_EQ(axis->sign_of(ExactVector3{1.0, 1.0, 0.0}), Sign::zero);
  }
  const auto straight = ray(0, 7.0, -5.0);
  ASSERT_TRUE(straight && straight->rational() != nullptr);
  EXPECT_EQ(straight->sign_of(ExactVector3{1.0, 1.0, -2.0}), Sign::zero);
}

// The binary64 number nearest to π/2 is less than π/2.
TEST(Fov, EndsAtARightAngle) {
  const double last = std::numbers::pi / 2, next = std::nextafter(last, 2);
  const ExactVector3 ahead{0.0, 0.0, 1.0};
  for (const double omega : {1.0, -1.0, 0x1p-100, 0x1p-1000}) {
    const double size = 1 / std::abs(omega);
    const auto d = ray(omega, last * size, 0.0);
    ASSERT_TRUE(d.has_value());
    EXPECT_EQ(d->sign_of(ahead), Sign::positive);
    EXPECT_GT(d->box()[2].lower, 0);
    EXPECT_FALSE(ray(omega, next * size, 0.0).has_value());
    EXPECT_FALSE(ray(omega, last * size, Dyadic(size).scaled(-20)).has_value());
  }
  EXPECT_FALSE(ray(3.141592653589793, 0x1.0000000000001p-1, 0.0).has_value());
}

TEST(Fov, EndsAtMaxRadius) {
  for (const double omega : {0.0, 0.5, -1.5}) {
    Lens lens = fov(omega);
    lens.max_radius = 0.75;
    const double size = std::abs(omega), tangent = std::tan(0.75);
    const double r = size == 0 ? tangent : std::atan(2 * std::tan(size / 2) * tangent) / size;
    EXPECT_TRUE(Preimages({}, lens).of(r * (1 - 1e-15), 0.0).has_value());
    EXPECT_FALSE(Preimages({}, lens).of(r * (1 + 1e-15), 0.0).has_value());
    EXPECT_TRUE(Preimages({}, lens).of(0.0, 0.0).has_value());
  }
}

// K⁻¹ overflows in binary64, and (x_d, y_d) may be as small as 1e-300.
TEST(Fov, HasFocalLengthsNearTheEndOfBinary64) {
  for (const double f : {0x1p1000, -0x1p1000, 0x1p-1000, 0x1.fffffffffffffp1023}) {
    Projection camera;
    camera.fx = camera.fy = f;
    const Preimages preimages(camera, fov(1.25));
    const auto d = preimages.of(Dyadic(f).scaled(-2), Dyadic(f).scaled(-1));  // (¼, ½)
    ASSERT_TRUE(d.has_value()) << f;
    expect_encloses(*d, direction_of(1.25, {0.25, 0.5}));
    const auto near_axis = preimages.of(Dyadic(f).scaled(-1000), Dyadic(f).scaled(-999));
    ASSERT_TRUE(near_axis.has_value()) << f;
    EXPECT_EQ(near_axis->sign_of(ExactVector3{2.0, -1.0, 0.0}), Sign::zero);
    EXPECT_EQ(near_axis->sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::positive);
  }
}

}  // namespace
}  // namespace fathom::lens
