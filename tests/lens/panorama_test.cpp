// Directions of panoramas against the oracle: enclosures, signs of forms, ties, poles and seams.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fathom/lens/preimages.h"
#include "tests/effort.h"
#include "tests/lens/expect_direction.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::Direction;

struct SineAndCosine {
  ArbBall sine, cosine;
};

/// Of an angle in turns.
SineAndCosine of_turns(const ArbBall& turns) {
  SineAndCosine result;
  arb_sin_cos_pi(result.sine, result.cosine, turns + turns, ArbBall::bits);
  return result;
}

/// The definition in the specification.
Direction defined(const Projection& p, const Dyadic& u, const Dyadic& v) {
  const ArbBall shift = ArbBall(0.5) - ArbBall(p.pixel_centre);
  const ArbBall x = (ArbBall(u) - ArbBall(p.cx) - shift) / ArbBall(p.fx);
  const ArbBall y = (ArbBall(v) - ArbBall(p.cy) - shift) / ArbBall(p.fy);
  const SineAndCosine around = of_turns(x);
  if (p.lens->model == LensModel::cylindrical) return {around.sine, y, around.cosine};
  const SineAndCosine down = of_turns(y * ArbBall(0.5));
  return {down.cosine * around.sine, down.sine, down.cosine * around.cosine};
}

Projection panorama(LensModel model, double width, double height) {
  Projection p{.fx = width, .fy = height};
  p.lens = Lens{model};
  return p;
}

std::optional<ExactDirection> ray(const Projection& p, const Dyadic& u, const Dyadic& v) {
  return Preimages(p, *p.lens).of(u, v);
}

/// Of a sample `x` turns and `y` half turns from the middle; of a cylinder, y is the slope.
ExactDirection ray_at(LensModel model, int x, int in_turn, int y, int in_half_turn) {
  const auto d = ray(panorama(model, in_turn, in_half_turn), x, y);
  EXPECT_TRUE(d.has_value());
  return *d;
}

class Panoramas : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Panoramas,
                         ::testing::Values(LensModel::equirectangular, LensModel::cylindrical),
                         [](const auto& model) { return std::string(name_of(model.param)); });

TEST_P(Panoramas, SeeAsTheOracleDoes) {
  int behind = 0, aside = 0;
  for (std::uint64_t seed = 0; seed < 300 / checks::effort; ++seed) {
    std::mt19937_64 random(seed);
    const auto number = [&random](double size) {
      return size * std::ldexp(static_cast<double>(random() >> 11), -53);
    };
    Projection p = panorama(GetParam(), 100 + number(1000), 500 + number(500));
    p.cx = number(1000);
    p.cy = 250 + number(100);
    p.pixel_centre = number(1);
    const Dyadic u = number(1000), v = 150 + number(200);
    const auto d = ray(p, u, v);
    ASSERT_TRUE(d.has_value()) << seed;
    const Direction exact = defined(p, u, v);
    behind += exact[2].sign() < 0 ? 1 : 0;
    aside += (exact[0] * exact[0] - exact[2] * exact[2]).sign() > 0 ? 1 : 0;
    expect_encloses(*d, exact);
    for (const int offset : {4, 40, 100, 250, 380})
      expect_signs_of_oracle(*d, exact, offset, random);
  }
  if (checks::effort == 1) {
    EXPECT_GT(behind, 100);
    EXPECT_GT(aside, 100);
  }
}

// At each multiple of a quarter turn a component is exactly 0.
TEST_P(Panoramas, QuartersOfATurnAreExact) {
  constexpr std::array sines{0, 1, 0, -1};
  for (int quarters = -9; quarters < 10; ++quarters) {
    const auto number = static_cast<std::size_t>(quarters + 12);
    const ExactDirection d = ray_at(GetParam(), quarters, 4, 1, 7);
    const int sine = sines[number % 4], cosine = sines[(number + 1) % 4];
    EXPECT_EQ(d.sign_of(ExactVector3{1.0, 0.0, 0.0}), sign_of(sine)) << quarters;
    EXPECT_EQ(d.sign_of(ExactVector3{0.0, 0.0, 1.0}), sign_of(cosine)) << quarters;
    EXPECT_EQ(d.sign_of(ExactVector3{0.0, 1.0, 0.0}), Sign::positive);
    const auto enclosed = d.enclosure(60);
    const auto& zero = sine == 0 ? enclosed[0] : enclosed[2];
    EXPECT_TRUE(zero.low.is_zero() && zero.high.is_zero());
    EXPECT_EQ(d.box()[sine == 0 ? 0 : 2].lower, 0);
  }
}

// Edges in the meridian planes x = ±z meet samples at 45°, whatever their latitude. A plane that is
// off by 2^−3000 does not.
TEST_P(Panoramas, MeridianPlanesMeetSamplesAt45Degrees) {
  const Dyadic little = Dyadic(1.0).scaled(-3000);
  for (const int latitude : {-2, 0, 1, 3}) {
    const ExactDirection right = ray_at(GetParam(), 1, 8, latitude, 7);
    EXPECT_EQ(right.sign_of(ExactVector3{1.0, 0.0, -1.0}), Sign::zero);
    EXPECT_EQ(right.sign_of(ExactVector3{1.0, 0.0, little - 1.0}), Sign::positive);
    EXPECT_EQ(right.sign_of(ExactVector3{1.0, 0.0, -little - 1.0}), Sign::negative);
    const ExactDirection behind = ray_at(GetParam(), -5, 8, latitude, 7);
    EXPECT_EQ(behind.sign_of(ExactVector3{1.0, 0.0, 1.0}), Sign::zero);
    EXPECT_EQ(behind.sign_of(ExactVector3{1.0, 0.0, 1.0 + little}), Sign::negative);
  }
}

// tan² 60° = 3 and tan² 30° = ⅓, so cones around the vertical planes meet all latitudes.
TEST_P(Panoramas, ConesMeetSamplesAt30And60Degrees) {
  const Dyadic little = Dyadic(1.0).scaled(-3000);
  const QuadraticForm cone{{1.0, 0.0, -3.0, 0.0, 0.0, 0.0}};
  for (const int latitude : {-2, 0, 3}) {
    const ExactDirection d = ray_at(GetParam(), 1, 6, latitude, 7);
    EXPECT_EQ(d.sign_of(cone), Sign::zero);
    EXPECT_EQ(d.sign_of(QuadraticForm{{1.0, 0.0, little - 3.0, 0.0, 0.0, 0.0}}), Sign::positive);
    EXPECT_EQ(ray_at(GetParam(), 5, 12, latitude, 7)
                  .sign_of(QuadraticForm{{3.0, 0.0, -1.0, 0.0, 0.0, 0.0}}),
              Sign::zero);
  }
  EXPECT_EQ(ray_at(GetParam(), 1, 7, 0, 7).sign_of(cone), Sign::negative);
}

// sin 30° = ½: 4y² = |d|² at this latitude. With cos 36° − cos 72° = ½, z = ¼ where λ = 72° and
// φ = ∓36°.
TEST(Equirectangular, ConesMeetSamplesOfOneLatitude) {
  constexpr auto model = LensModel::equirectangular;
  const QuadraticForm at_30{{-1.0, 3.0, -1.0, 0.0, 0.0, 0.0}};
  for (const int around : {0, 1, 5, 9}) {
    EXPECT_EQ(ray_at(model, around, 11, 1, 6).sign_of(at_30), Sign::zero);
    EXPECT_EQ(ray_at(model, around, 11, -1, 6).sign_of(at_30), Sign::zero);
    EXPECT_EQ(ray_at(model, around, 11, 100001, 600000).sign_of(at_30), Sign::positive);
  }
  const QuadraticForm quarter{{-1.0, -1.0, 15.0, 0.0, 0.0, 0.0}};
  EXPECT_EQ(ray_at(model, 1, 5, 1, 5).sign_of(quarter), Sign::zero);
  EXPECT_EQ(ray_at(model, 1, 5, 2, 5).sign_of(quarter), Sign::negative);
}

// |d|² = 1 + (V/fy)² there: distances have midpoints of their own.
TEST(Cylindrical, ConesMeetSamplesOfOneHeight) {
  const ExactDirection d = ray_at(LensModel::cylindrical, 3, 17, 3, 4);
  EXPECT_EQ(d.sign_of(QuadraticForm{{9.0, -16.0, 9.0, 0.0, 0.0, 0.0}}), Sign::zero);
  EXPECT_EQ(d.sign_of(QuadraticForm{{9.0, -15.0, 9.0, 0.0, 0.0, 0.0}}), Sign::positive);
}

// The numbers of the image are no fractions of small denominators, and ties are found at once.
TEST_P(Panoramas, FindTiesWithoutFactorizing) {
  const double width = 2047.9999999999998;
  const Projection p = panorama(GetParam(), width, 999.99999999999989);
  const auto d = ray(p, Dyadic(width).scaled(-3), 123.4567);
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->sign_of(ExactVector3{1.0, 0.0, -1.0}), Sign::zero);
  EXPECT_EQ(d->sign_of(ExactVector3{1.0, 0.0, Dyadic(0x1p-60) - 1.0}), Sign::positive);
  const auto other = ray(p, Dyadic(width).scaled(-3) + Dyadic(1.0).scaled(-2000), 123.4567);
  EXPECT_EQ(other->sign_of(ExactVector3{1.0, 0.0, -1.0}), Sign::positive);
}

TEST_P(Panoramas, HaveNumbersNearTheEndsOfBinary64) {
  for (const double size : {0x1p1000, 0x1p-1000, 0x1.fffffffffffffp1023}) {
    const Projection p = panorama(GetParam(), size, size);
    const Dyadic u = Dyadic(size).scaled(-3), v = Dyadic(size).scaled(-2);
    const auto d = ray(p, u, v);
    ASSERT_TRUE(d.has_value());
    expect_encloses(*d, defined(p, u, v));
    EXPECT_EQ(d->sign_of(ExactVector3{1.0, 0.0, -1.0}), Sign::zero);
  }
}

// A turn more is the same direction; the seam at half a turn is no end.
TEST_P(Panoramas, ArePeriodic) {
  for (const int turns : {-3, 1, 1000000}) {
    const auto once = ray_at(GetParam(), 5, 16, 2, 9),
               again = ray_at(GetParam(), 5 + 16 * turns, 16, 2, 9);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(once.enclosure(200)[k].low == again.enclosure(200)[k].low);
  }
  const ExactDirection left = ray_at(GetParam(), -1, 2, 0, 9),
                       right = ray_at(GetParam(), 1, 2, 0, 9);
  for (const ExactDirection& d : {left, right}) {
    EXPECT_EQ(d.sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::zero);
    EXPECT_EQ(d.sign_of(ExactVector3{0.0, 1.0, 0.0}), Sign::zero);
    EXPECT_EQ(d.sign_of(ExactVector3{0.0, 0.0, 1.0}), Sign::negative);
  }
}

TEST(Equirectangular, EndsAtThePoles) {
  const Projection p = panorama(LensModel::equirectangular, 12, 6);
  for (const double pole : {-3.0, 3.0}) {
    for (const double u : {0.0, 1.0, 2.5}) {
      const auto d = ray(p, u, pole);
      ASSERT_TRUE(d.has_value() && d->rational() != nullptr);
      const ExactVector3 expected{0.0, pole / 3, 0.0};
      for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE((*d->rational())[k] == expected[k]);
      EXPECT_FALSE(ray(p, u, Dyadic(pole) * (Dyadic(1.0) + Dyadic(1.0).scaled(-2000))).has_value());
      const auto before = ray(p, u, Dyadic(pole) * (Dyadic(1.0) - Dyadic(1.0).scaled(-200)));
      ASSERT_TRUE(before.has_value());
      EXPECT_EQ(before->sign_of(ExactVector3{0.0, pole, 0.0}), Sign::positive);
    }
  }
  EXPECT_EQ(
      ray(p, 0.0, Dyadic(3.0) - Dyadic(1.0).scaled(-2000))->sign_of(ExactVector3{0.0, 0.0, 1.0}),
      Sign::positive);
}

TEST_P(Panoramas, EndAtMaxRadius) {
  Projection p = panorama(GetParam(), 2 * std::numbers::pi, 100);
  p.lens->max_radius = 1.5;
  EXPECT_TRUE(ray(p, 1.4999, 0.0).has_value());
  EXPECT_TRUE(ray(p, -1.4999, 0.0).has_value());
  EXPECT_FALSE(ray(p, 1.5001, 0.0).has_value());
  EXPECT_FALSE(ray(p, 1.4999, 20.0).has_value());
  p.lens->max_radius = 3.2;
  EXPECT_TRUE(ray(p, std::numbers::pi, 0.0).has_value());
}

}  // namespace
}  // namespace fathom::lens
