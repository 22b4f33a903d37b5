// Directions of fisheyes against the oracle: enclosures, signs of forms, ties, and where they end.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/lens/exact_direction.h"
#include "fathom/lens/preimages.h"
#include "tests/effort.h"
#include "tests/lens/expect_direction.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::Direction;
using oracle::expect_encloses;
using oracle::expect_signs_of_oracle;
using oracle::NamedParameters;
using Point = oracle::OraclePoint<ArbBall>;

/// (m·sin θ/θ, cos θ) with θ = |m|.
Direction lifted(const Point& m) {
  const ArbBall angle = (m.x * m.x + m.y * m.y).root();
  ArbBall sine, cosine;
  arb_sin_cos(sine, cosine, angle, ArbBall::bits);
  return {m.x * sine / angle, m.y * sine / angle, cosine};
}

class Fisheyes : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Fisheyes, ::testing::ValuesIn(oracle::fisheye_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

/// A camera that sees up to about 140° from its axis if the lens changes nothing.
Projection wide_camera(std::mt19937_64& random) {
  Projection camera = oracle::random_camera(random);
  camera.fx /= 4;
  camera.fy /= 4;
  return camera;
}

TEST_P(Fisheyes, SeeAsTheOracleDoes) {
  int found = 0, beyond_90_degrees = 0;
  for (std::uint64_t seed = 0; seed < 30 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    const Lens lens =
        oracle::random_lens(random, GetParam(), std::array{0.01, 0.05, 0.3}[seed % 3]);
    const Projection camera = wide_camera(random);
    const Preimages preimages(camera, lens);
    ASSERT_LE(preimages.disc(), end_of_angles);
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {300.5, 200.25}, {100.25, 600.75}, {900.5, 12.5}}) {
      const NamedParameters numbers(lens);
      const auto d = preimages.of(u, v);
      const auto m = oracle::preimage(camera, numbers, u, v, preimages.disc());
      ASSERT_EQ(d.has_value(), m.has_value()) << seed << ' ' << u << ' ' << v;
      if (!d) continue;
      ++found;
      const Direction exact = lifted(*m);
      beyond_90_degrees += exact[2].sign() < 0 ? 1 : 0;
      expect_encloses(*d, exact);
      for (const int offset : {4, 40, 100, 250, 380})
        expect_signs_of_oracle(*d, exact, offset, random);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort == 1) {
    EXPECT_GT(beyond_90_degrees, 0);
  }
}

// A radial lens has m parallel to y = (a, b): the form (b, −a, 0) is 0 on its ray, and so are the
// quadratic forms in which each coefficient of tan θ is 0.
TEST(Fisheye, SeesInThePlaneOfItsAxis) {
  const Dyadic a = 0.75, b = 1.25, e = Dyadic(1.0).scaled(-3000);
  for (const Lens& lens :
       {Lens{LensModel::fisheye}, Lens{LensModel::opencv_fisheye, {0.1, -0.01}}}) {
    const Preimages preimages({}, lens);
    const auto d = preimages.of(a, b);
    ASSERT_TRUE(d.has_value());
    EXPECT_EQ(d->rational(), nullptr);
    EXPECT_EQ(d->sign_of(ExactVector3{b, -a, 0.0}), Sign::zero);
    EXPECT_EQ(d->sign_of(ExactVector3{b, e - a, 0.0}), Sign::positive);
    EXPECT_EQ(d->sign_of(ExactVector3{b, -e - a, 0.0}), Sign::negative);
    const Sign forward = d->sign_of(ExactVector3{0.0, 0.0, 1.0});
    EXPECT_EQ(d->sign_of(ExactVector3{b, -a, e}), forward);
    EXPECT_EQ(d->sign_of(square_of({b, -a, 0.0})), Sign::zero);
    EXPECT_EQ(d->sign_of(QuadraticForm{{0.0, 0.0, 0.0, 0.0, b, -a}}), Sign::zero);
    EXPECT_EQ(d->sign_of(QuadraticForm{{0.0, 0.0, e, 0.0, b, -a}}), Sign::positive);
    EXPECT_EQ(d->sign_of(QuadraticForm{{0.0, 0.0, -e, 0.0, b, -a}}), Sign::negative);
    EXPECT_EQ(d->sign_of(QuadraticForm{{0.0, 0.0, 0.0, 0.0, b, e - a}}), forward);
  }
}

TEST(Fisheye, SeesItsAxisExactly) {
  const auto d = Preimages({}, Lens{LensModel::opencv_fisheye, {0.1}}).of(0.0, 0.0);
  ASSERT_TRUE(d.has_value() && d->rational() != nullptr);
  EXPECT_EQ(d->sign_of(ExactVector3{1.0, 1.0, 0.0}), Sign::zero);
  EXPECT_EQ(d->sign_of(ExactVector3{1.0, 0.0, 1.0}), Sign::positive);
}

// The greatest binary64 number whose root is below π.
TEST(Fisheye, EndsBefore180Degrees) {
  ArbBall pi;
  arb_const_pi(pi, ArbBall::bits);
  const double next = std::nextafter(end_of_angles, std::numeric_limits<double>::infinity());
  EXPECT_GT((pi * pi - ArbBall(end_of_angles)).sign(), 0);
  EXPECT_LT((pi * pi - ArbBall(next)).sign(), 0);

  const Preimages preimages({}, Lens{LensModel::fisheye});
  EXPECT_EQ(preimages.disc(), end_of_angles);
  const double last = std::sqrt(end_of_angles);  // rounded
  EXPECT_TRUE(preimages.of(last * (1 - 0x1p-52), 0.0).has_value());
  EXPECT_FALSE(preimages.of(last * (1 + 0x1p-51), 0.0).has_value());
  EXPECT_FALSE(preimages.of(1e300, 1e300).has_value());
  const auto nearly = preimages.of(last * (1 - 0x1p-52), 0.0);
  EXPECT_EQ(nearly->sign_of(ExactVector3{0.0, 0.0, -1.0}), Sign::positive);
  EXPECT_EQ(nearly->sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::positive);
}

TEST(Fisheye, EndsAtMaxRadius) {
  Lens lens{LensModel::fisheye};
  lens.max_radius = 1.5;
  const Preimages preimages({}, lens);
  EXPECT_EQ(preimages.disc(), end_of_angles);
  EXPECT_TRUE(preimages.of(1.5, 0.0).has_value());
  EXPECT_FALSE(preimages.of(std::nextafter(1.5, 2), 0.0).has_value());
  EXPECT_FALSE(preimages.of(1.5, 0x1p-500).has_value());
}

// K⁻¹ overflows in binary64, and m may be as small as 1e-300.
TEST(Fisheye, HasFocalLengthsNearTheEndOfBinary64) {
  for (const double f : {0x1p1000, -0x1p1000, 0x1p-1000, 0x1.fffffffffffffp1023}) {
    Projection camera;
    camera.fx = camera.fy = f;
    const Preimages preimages(camera, Lens{LensModel::fisheye});
    const Dyadic u = Dyadic(f).scaled(-2), v = Dyadic(f).scaled(-1);  // m = (¼, ½)
    const auto d = preimages.of(u, v);
    ASSERT_TRUE(d.has_value()) << f;
    expect_encloses(*d, lifted({0.25, 0.5}));
    const auto near_axis = preimages.of(0x1p-1000, 0x1p-999);
    ASSERT_EQ(near_axis.has_value(), true) << f;
    EXPECT_EQ(near_axis->sign_of(ExactVector3{2.0, -1.0, 0.0}), Sign::zero);
  }
}

// At 90°, z is 0 only where θ = π/2, which no rational sample has.
TEST(Fisheye, IsNeverExactlyAt90Degrees) {
  const Preimages preimages({}, Lens{LensModel::fisheye});
  const double half_pi = std::numbers::pi / 2;  // less than π/2
  const ExactVector3 z{0.0, 0.0, 1.0};
  EXPECT_EQ(preimages.of(half_pi, 0.0)->sign_of(z), Sign::positive);
  EXPECT_EQ(preimages.of(std::nextafter(half_pi, 2), 0.0)->sign_of(z), Sign::negative);
}

}  // namespace
}  // namespace fathom::lens
