// The forward maps: against the oracle and OpenCV's own numbers. Other programs:
// foreign_points_test.cpp.
#include "fathom/lens/stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "fathom/lens/sample_plane.h"
#include "tests/lens/lens_oracle.h"
#include "tests/places.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::NamedParameters;

class Stages : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Stages, ::testing::ValuesIn(oracle::stage_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

// What binary64 makes of the formulas errs by a few units of roundoff of the magnitudes: 32 covers
// the roundings of powers of q, of the scheme of Horner, of N/D and of the sum.
TEST_P(Stages, AreThoseOfTheOracle) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  double greatest_share = 0;
  for (int i = 0; i < 200; ++i) {
    const Lens lens = oracle::random_lens(random, GetParam(), 0.5);
    const auto numbers = stage_of(lens);
    const double x = uniform(random), y = uniform(random);
    const auto exact = oracle::distorted<ArbBall>(NamedParameters(lens), x, y);
    const auto value = stage_value(numbers, x, y), size = stage_magnitudes(numbers, x, y);
    const double bound = 32 * 0x1p-53;
    ASSERT_LE(exact.x.v.distance_from(value.x), bound * size.x);
    ASSERT_LE(exact.y.v.distance_from(value.y), bound * size.y);
    greatest_share = std::max(greatest_share, exact.x.v.distance_from(value.x) / (bound * size.x));
    const auto J = stage_jacobian(numbers, x, y);
    const double tolerance = 1e-12 * (1 + size.x + size.y) * (1 + size.x + size.y);
    EXPECT_LE(exact.x.dx.distance_from(J.xx), tolerance);
    EXPECT_LE(exact.x.dy.distance_from(J.xy), tolerance);
    EXPECT_LE(exact.y.dx.distance_from(J.yx), tolerance);
    EXPECT_LE(exact.y.dy.distance_from(J.yy), tolerance);
  }
  EXPECT_GT(greatest_share, 0.01);
}

TEST(Stage, HasNoLeadingZeroes) {
  Lens lens;
  lens.model = LensModel::full_opencv;
  EXPECT_TRUE(is_identity(stage_of(lens)));
  lens.distortion = {0.1, 0, 0, 0, 0, 0, 0.5};
  const auto numbers = stage_of(lens);
  EXPECT_EQ(numbers.numerator.size(), 2U);
  EXPECT_EQ(numbers.denominator.size(), 3U);
  EXPECT_TRUE(is_radial(numbers));
  EXPECT_FALSE(is_identity(numbers));
  lens.distortion[3] = 1;
  EXPECT_FALSE(is_radial(stage_of(lens)));
  lens.model = LensModel::division;
  EXPECT_THROW(stage_of(lens), std::logic_error);
}

/// (x, y) after the stage and the tilt, in binary64.
StagePoint<double> projected(const Lens& lens, double x, double y) {
  const auto p = stage_value(stage_of(lens), x, y);
  const std::optional<Tilt> tilt = Tilt::of(lens);
  if (!tilt) return p;
  const auto row = [&](int i) {
    const ExactVector3& m = tilt->matrix()[i];
    return ArbBall(m[0]) * ArbBall(p.x) + ArbBall(m[1]) * ArbBall(p.y) + ArbBall(m[2]);
  };
  return {(row(0) / row(2)).approximate(), (row(1) / row(2)).approximate()};
}

TEST(Stage, IsOpenCVs) {
  std::ifstream file(test::source_dir() / "tests/lens/points_of_opencv.txt");
  int count = 0;
  for (std::string line; std::getline(file, line); ++count) {
    std::istringstream words(line);
    std::array<double, 18> values{};
    for (double& value : values) {
      std::string word;
      words >> word;
      value = std::strtod(word.c_str(), nullptr);
    }
    Lens lens;
    lens.model = LensModel::opencv_14;
    std::copy_n(values.begin(), 14, lens.distortion.begin());
    const auto p = projected(lens, values[14], values[15]);
    EXPECT_NEAR(100 * p.x, values[16], 1e-12) << line;
    EXPECT_NEAR(100 * p.y, values[17], 1e-12) << line;
    // The models whose numbers are the first ones of these.
    if (values[8] == 0 && values[12] == 0) {
      lens.model = LensModel::full_opencv;
      EXPECT_EQ(projected(lens, values[14], values[15]).x, p.x);
    }
    if (values[4] == 0) {
      lens.model = LensModel::opencv;
      EXPECT_EQ(projected(lens, values[14], values[15]).y, p.y);
    }
  }
  EXPECT_EQ(count, 60);
}

TEST(Tilt, IsTheOraclesAndUndone) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  int behind = 0;
  for (int i = 0; i < 100; ++i) {
    Lens lens;
    lens.model = LensModel::opencv_14;
    lens.distortion[12] = uniform(random);
    lens.distortion[13] = uniform(random);
    const Tilt tilt = Tilt::of(lens).value();
    const DistortedPoint p{uniform(random), uniform(random), 1.0};
    const auto& M = tilt.matrix();
    const ExactVector3 v{p.a, p.b, p.c};
    const oracle::OraclePoint<ArbBall> expected =
        oracle::tilted(NamedParameters(lens), {ArbBall(p.a), ArbBall(p.b)});
    const Dyadic c = dot(M[2], v);
    EXPECT_TRUE((ArbBall(dot(M[0], v)) / ArbBall(c)).meets(expected.x));
    EXPECT_TRUE((ArbBall(dot(M[1], v)) / ArbBall(c)).meets(expected.y));
    const bool is_behind = c.sign() != Sign::positive;
    const auto undone = is_behind ? tilt.undone({-dot(M[0], v), -dot(M[1], v), -c})
                                  : tilt.undone({dot(M[0], v), dot(M[1], v), c});
    EXPECT_EQ(undone.has_value(), !is_behind);
    behind += is_behind;
    if (!undone) continue;
    EXPECT_TRUE(undone->a == p.a * undone->c);
    EXPECT_TRUE(undone->b == p.b * undone->c);
  }
  EXPECT_GT(behind, 0);
  Lens lens;
  lens.model = LensModel::opencv_14;
  EXPECT_FALSE(Tilt::of(lens).has_value());
}

}  // namespace
}  // namespace fathom::lens
