// Q: known answers, and that it is the last binary64 number, by the oracle's determinants.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>

#include "fathom/lens/definiteness.h"
#include "fathom/lens/polynomial_stage.h"
#include "tests/effort.h"
#include "tests/lens/lens_oracle.h"
#include "tests/special_values.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::NamedParameters;

double disc_of(LensModel model, std::array<double, 14> distortion) {
  Lens lens;
  lens.model = model;
  lens.distortion = distortion;
  return greatest_disc(stage_of(lens));
}

// f = r·(1 + k·r²), f' = 1 + 3k·q: the fold is at q = ⅓, which binary64 rounds down.
TEST(Disc, OfOneTermEndsAtTheFold) {
  EXPECT_EQ(disc_of(LensModel::simple_radial, {-1}), 1.0 / 3);
  EXPECT_EQ(disc_of(LensModel::simple_radial, {1}), infinity);
  EXPECT_EQ(disc_of(LensModel::simple_radial, {0}), infinity);
}

// f' = 1 + 9q − 10q² has the roots 1 and −1/10. D = 1 − q/4 has the root 4; N is the same.
TEST(Disc, EndsBeforeARootThatIsABinary64Number) {
  EXPECT_EQ(disc_of(LensModel::radial, {3, -2}), std::nextafter(1.0, 0));
  EXPECT_EQ(disc_of(LensModel::full_opencv, {-0.25, 0, 0, 0, 0, -0.25}), std::nextafter(4.0, 0));
  EXPECT_EQ(disc_of(LensModel::full_opencv, {0, 0, 1e-3, 0, 0, -0.25}), std::nextafter(4.0, 0));
}

// f' = 1 − 30q + 225q² = (1 − 15q)²: it touches 0 at 1/15, which binary64 rounds up or down.
TEST(Disc, EndsWhereTheSlopeTouchesZero) {
  const double nearest = 1.0 / 15;
  const bool is_below = std::fma(nearest, 15, -1) < 0;
  EXPECT_EQ(disc_of(LensModel::radial, {-10, 45}), is_below ? nearest : std::nextafter(nearest, 0));
}

// A alone: with p = (0, p1), the determinant at (0, y) is (1 + 2·p1·y)·(1 + 6·p1·y).
TEST(Disc, OfATangentialTermEndsAtTheNearestFold) {
  const double p1 = 1.0 / 6 + 0x1p-20;
  const double q = disc_of(LensModel::opencv, {0, 0, p1, 0});
  const double expected = 1 / (36 * p1 * p1);
  EXPECT_NEAR(q, expected, 1e-15);
  EXPECT_LT(q, 1);
}

// A thread keeps fewer discs than there are lenses here. The lenses differ in one of k1, k2, p1, p2
// and k4, and no two discs are the same.
TEST(Disc, OfAStageIsThatOfItsOwnNumbers) {
  constexpr std::array<std::size_t, 5> places{0, 1, 2, 3, 5};
  constexpr std::size_t lenses = 20;
  std::set<double> discs;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < lenses; ++i) {
      Lens lens{LensModel::full_opencv, {-0.25, 0.02, 0.001, -0.002, 0, 0.01}};
      lens.distortion.at(places.at(i % places.size())) -=
          0.001 * static_cast<double>(1 + i / places.size());
      const double disc = greatest_disc(stage_of(lens));
      discs.insert(disc);
      for (int again = 0; again < 2; ++again) EXPECT_EQ(PolynomialStage(lens).disc, disc) << i;
    }
  }
  EXPECT_EQ(discs.size(), lenses);
}

TEST(Disc, MayBeThePlane) {
  EXPECT_EQ(disc_of(LensModel::opencv, {0.5, 0.1, 0.001, 0.002}), infinity);
}

// L = 1 − q: at q = 2 both eigenvalues, 1 − 3q and 1 − q, are negative, and the determinant is not.
TEST(Definiteness, IsNotThatOfTheDeterminantAlone) {
  Lens lens;
  lens.model = LensModel::simple_radial;
  lens.distortion[0] = -1;
  const Definiteness exact(as_polynomials(stage_of(lens)));
  EXPECT_TRUE(exact.holds_on_circle(0.25));
  EXPECT_FALSE(exact.holds_on_circle(0.5));
  EXPECT_FALSE(exact.holds_on_circle(2.0));
  EXPECT_EQ(exact.holds_on_ring(0.125, 0.25).verdict, Definiteness::Verdict::holds);
  EXPECT_EQ(exact.holds_on_ring(0.125, 2.0).verdict, Definiteness::Verdict::fails);
}

class Discs : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Discs, ::testing::ValuesIn(oracle::stage_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

/// The sign of the determinant at |m|² = q.
int sign_at(const NamedParameters& n, double q, const ArbBall& angle) {
  ArbBall c, s;
  arb_sin_cos(s, c, angle, ArbBall::bits);
  const ArbBall r = ArbBall(q).root();
  return oracle::sign_of_determinant(n, {r * c, r * s});
}

double determinant(const NamedParameters& n, double q, double angle) {
  const double r = std::sqrt(q);
  const auto J = oracle::distorted(n, r * std::cos(angle), r * std::sin(angle));
  const double side = (J.x.dy + J.y.dx) / 2;
  return J.x.dx * J.y.dy - side * side;
}

/// The angle at which the determinant is least, to 2⁻²⁵: there it is least to some 2⁻⁵⁰.
double least_angle(const NamedParameters& n, double q) {
  double best = 0;
  for (int i = 0; i < 720; ++i) {
    const double angle = i * std::numbers::pi / 360;
    if (determinant(n, q, angle) < determinant(n, q, best)) best = angle;
  }
  for (double step = 0.01; step > 1e-8; step /= 2)
    for (const double angle : {best - step, best + step})
      if (determinant(n, q, angle) < determinant(n, q, best)) best = angle;
  return best;
}

TEST_P(Discs, AreRegularWithinAndNotBeyond) {
  int ends = 0;
  for (std::uint64_t seed = 0; seed < 40 / checks::effort + 1; ++seed) {
    std::mt19937_64 random(seed);
    const Lens lens = oracle::random_lens(random, GetParam(), std::array{0.1, 0.5}[seed % 2]);
    const NamedParameters numbers(lens);
    const double q = greatest_disc(stage_of(lens));
    // Within: at many places.
    for (int i = 1; i <= 400; ++i) {
      const double share = i == 400 ? 1 : i / 400.0;
      EXPECT_EQ(sign_at(numbers, std::min(q, 1e4) * share, ArbBall(2.4 * i)), 1);
    }
    if (std::isinf(q)) continue;
    EXPECT_EQ(sign_at(numbers, q, ArbBall(least_angle(numbers, q))), 1);
    // Beyond: the fold, or the pole, lies within 2⁻⁴⁰ of Q, as far as binary64 shows.
    const double beyond = q * (1 + 0x1p-40);
    const auto stage = stage_of(lens);
    const bool is_beyond_pole = horner(stage.denominator, beyond) <= 0;
    const bool is_beyond_fold =
        sign_at(numbers, beyond, ArbBall(least_angle(numbers, beyond))) <= 0;
    EXPECT_TRUE(is_beyond_pole || is_beyond_fold) << q;
    ++ends;
  }
  EXPECT_GT(ends, 0);
}

// The exact statement about the next number: its circle is not regular, or D is not positive in it.
TEST_P(Discs, EndAtTheLastNumber) {
  for (std::uint64_t seed = 0; seed < 40 / checks::effort + 1; ++seed) {
    std::mt19937_64 random(seed);
    const auto stage = stage_of(oracle::random_lens(random, GetParam(), 0.4));
    const double q = greatest_disc(stage), next = std::nextafter(q, infinity);
    if (std::isinf(q)) continue;
    const Definiteness exact(as_polynomials(stage));
    EXPECT_TRUE(exact.holds_on_circle(q));
    EXPECT_TRUE(!exact.holds_on_circle(next) ||
                exact.denominator().at(next).sign() != Sign::positive);
  }
}

}  // namespace
}  // namespace fathom::lens
