// Directions of FTHETA against its formula in Arb: samples, signs of forms, ties, and its end.
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
using Coefficients = std::array<double, 14>;

ArbBall angle_at(const Coefficients& p, const ArbBall& r) {
  ArbBall angle(0.0);
  for (std::size_t i = 6; i-- > 0;) angle = angle * r + ArbBall(p[i]);
  return angle;
}

/// The direction of the specification.
Direction direction_of(const Coefficients& p, const Point& y) {
  const ArbBall r = (y.x * y.x + y.y * y.y).root();
  ArbBall sine, cosine;
  arb_sin_cos(sine, cosine, angle_at(p, r), ArbBall::bits);
  return {y.x * sine / r, y.y * sine / r, cosine};
}

Lens ftheta(const Coefficients& p) {
  return {LensModel::ftheta, p};
}

std::optional<ExactDirection> ray(const Coefficients& p, const Dyadic& x, const Dyadic& y) {
  return Preimages({}, ftheta(p)).of(x, y);
}

TEST(Ftheta, SeesAsTheOracleDoes) {
  int found = 0, beyond_90_degrees = 0, across = 0, without_ray = 0;
  for (std::uint64_t seed = 0; seed < 60 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Coefficients p{seed % 2 == 0 ? 0 : uniform(random), 1 + 0.5 * uniform(random)};
    for (std::size_t i = 2; i < 6; ++i) p[i] = 0.1 * uniform(random);
    Projection camera = oracle::random_camera(random);
    camera.fx /= 3;
    camera.fy /= 3;
    const Preimages preimages(camera, ftheta(p));
    const double end = AnglePolynomial(ftheta(p)).end();
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {300.5, 200.25}, {100.25, 600.75}, {900.5, 12.5}}) {
      const Point y = oracle::distorted_point(camera, u, v);
      const auto d = preimages.of(u, v);
      ASSERT_EQ(d.has_value(), (y.x * y.x + y.y * y.y).root().approximate() < end) << seed;
      if (!d) {
        ++without_ray;
        continue;
      }
      ++found;
      const Direction exact = direction_of(p, y);
      beyond_90_degrees += exact[2].sign() < 0 ? 1 : 0;
      across += (exact[0] * y.x).sign() < 0 ? 1 : 0;
      expect_encloses(*d, exact);
      for (const int offset : {4, 40, 100, 250, 380})
        oracle::expect_signs_of_oracle(*d, exact, offset, random);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort == 1) {
    EXPECT_GT(beyond_90_degrees, 0);
    EXPECT_GT(across, 0);
    EXPECT_GT(without_ray, 0);
  }
}

TEST(Ftheta, TiesInThePlaneOfItsAxis) {
  const Dyadic a = 0.75, b = 1.25, little = Dyadic(1.0).scaled(-3000);
  for (const Coefficients& p : {Coefficients{0, 1, 0.25}, Coefficients{0.25, 0, 0.5}}) {
    const ExactDirection d = *ray(p, a, b);
    EXPECT_EQ(d.sign_of(ExactVector3{b, -a, 0.0}), Sign::zero);
    EXPECT_EQ(d.sign_of(ExactVector3{b, little - a, 0.0}), Sign::positive);
    const Sign forward = d.sign_of(ExactVector3{0.0, 0.0, 1.0});
    EXPECT_EQ(d.sign_of(ExactVector3{b, -a, little}), forward);
    EXPECT_EQ(d.sign_of(square_of({b, -a, 0.0})), Sign::zero);
    EXPECT_EQ(d.sign_of(QuadraticForm{{0.0, 0.0, 0.0, 0.0, b, -a}}), Sign::zero);
    EXPECT_EQ(d.sign_of(QuadraticForm{{0.0, 0.0, -little, 0.0, b, -a}}), Sign::negative);
  }
}

// θ is 0 at the axis, or on a circle: there every sample sees the axis. Within the circle, rays go
// to the opposite side.
TEST(Ftheta, SeesItsAxisWhereTheAngleIsZero) {
  const auto axis = ray({0, 1}, 0.0, 0.0);
  ASSERT_TRUE(axis && axis->rational() != nullptr);
  EXPECT_EQ(axis->sign_of(ExactVector3{1.0, 1.0, 0.0}), Sign::zero);
  EXPECT_FALSE(ray({0.5, 1}, 0.0, 0.0).has_value());

  Projection camera;
  camera.fx = camera.fy = 10;
  const Dyadic little = Dyadic(1.0).scaled(-3000);
  // θ = r − ½, and θ = r² − ¼
  for (const Coefficients& p : {Coefficients{-0.5, 1}, Coefficients{-0.25, 0, 1}}) {
    const Preimages preimages(camera, ftheta(p));
    const auto on_circle = preimages.of(3.0, 4.0);
    ASSERT_TRUE(on_circle && on_circle->rational() != nullptr);
    EXPECT_EQ(on_circle->sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::zero);
    EXPECT_EQ(preimages.of(Dyadic(3.0) + little, 4.0)->sign_of(ExactVector3{1.0, 0.0, 0.0}),
              Sign::positive);
    EXPECT_EQ(preimages.of(Dyadic(3.0) - little, 4.0)->sign_of(ExactVector3{1.0, 0.0, 0.0}),
              Sign::negative);
  }
}

TEST(Ftheta, EndsWhereTheAngleCeasesToGrowOrIs180Degrees) {
  EXPECT_EQ(AnglePolynomial(ftheta({0, 1})).end(), std::numbers::pi);  // less than π
  EXPECT_EQ(AnglePolynomial(ftheta({0, 0.5})).end(), 2 * std::numbers::pi);
  EXPECT_EQ(AnglePolynomial(ftheta({0, 1, -0.25})).end(), std::nextafter(2, 1));
  EXPECT_EQ(AnglePolynomial(ftheta({0, 0, 0, 1, -0.75})).end(), std::nextafter(1, 0));
  const Coefficients p{0, 1, -0.25};
  EXPECT_TRUE(ray(p, std::nextafter(2, 1), 0.0).has_value());
  EXPECT_FALSE(ray(p, 2.0, 0.0).has_value());
  EXPECT_FALSE(ray(p, std::nextafter(2, 1), 0x1p-25).has_value());
  EXPECT_TRUE(ray({0, 1}, 0.0, std::numbers::pi).has_value());
  EXPECT_FALSE(ray({0, 1}, 0.0, std::nextafter(std::numbers::pi, 4)).has_value());
}

// The angle of a rational sample may be max_radius.
TEST(Ftheta, EndsAtMaxRadius) {
  Lens lens = ftheta({-1, 1});
  lens.max_radius = 0.5;
  const Preimages preimages({}, lens);
  EXPECT_TRUE(preimages.of(1.5, 0.0).has_value());
  EXPECT_FALSE(preimages.of(std::nextafter(1.5, 2), 0.0).has_value());
  EXPECT_TRUE(preimages.of(0.5, 0.0).has_value());
  EXPECT_FALSE(preimages.of(std::nextafter(0.5, 0), 0.0).has_value());
  EXPECT_FALSE(preimages.of(1.5, 0x1p-500).has_value());
}

TEST(Ftheta, HasFocalLengthsNearTheEndOfBinary64) {
  for (const double f : {0x1p1000, -0x1p1000, 0x1p-1000, 0x1.fffffffffffffp1023}) {
    Projection camera;
    camera.fx = camera.fy = f;
    const Coefficients p{0, 1, -0.125, 0.25};
    const Preimages preimages(camera, ftheta(p));
    const auto d = preimages.of(Dyadic(f).scaled(-2), Dyadic(f).scaled(-1));  // (¼, ½)
    ASSERT_TRUE(d.has_value()) << f;
    expect_encloses(*d, direction_of(p, {0.25, 0.5}));
    const auto near_axis = preimages.of(Dyadic(f).scaled(-1000), Dyadic(f).scaled(-999));
    ASSERT_TRUE(near_axis.has_value()) << f;
    EXPECT_EQ(near_axis->sign_of(ExactVector3{2.0, -1.0, 0.0}), Sign::zero);
  }
}

}  // namespace
}  // namespace fathom::lens
