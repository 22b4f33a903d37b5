// Bounds on a stage, against balls of Arb.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/fast/lenses/stage_lanes.h"
#include "fathom/lens/stage.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::NamedParameters;

class StageBoundsOf : public ::testing::TestWithParam<LensModel> {
 protected:
  double number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  /// A box of a random size, of which no end is 0.
  std::array<Interval, 2> box() {
    std::array<Interval, 2> sides;
    for (Interval& side : sides) {
      const double middle = number(-1, 1), half = std::ldexp(number(0.5, 1), -1 - below(8));
      side = {middle - half, middle + half};
    }
    return sides;
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  std::mt19937_64 random_{7};
};
INSTANTIATE_TEST_SUITE_P(Lenses, StageBoundsOf, ::testing::ValuesIn(oracle::stage_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

TEST_P(StageBoundsOf, OfABoxHoldForItsPoints) {
  int known = 0;
  double greatest_error = 0, least_growth = 100;
  for (int i = 0; i < 300; ++i) {
    const Lens lens = oracle::random_lens(random_, GetParam(), 0.5);
    const auto numbers = stage_of(lens);
    const auto sides = box();
    const StageBounds bounds = bounds_on_box(numbers, sides);
    if (bounds.growth == 0) continue;
    ++known;
    const auto point = [&] {
      return std::array{number(sides[0].lower, sides[0].upper),
                        number(sides[1].lower, sides[1].upper)};
    };
    const auto a = point(), b = point();
    const auto S = [&](const auto& m) {
      return oracle::distorted<ArbBall>(NamedParameters(lens), m[0], m[1]);
    };
    const auto at_a = S(a), at_b = S(b);
    const double dx = a[0] - b[0], dy = a[1] - b[1];
    const double growth =
        ((at_a.x.v - at_b.x.v).approximate() * dx + (at_a.y.v - at_b.y.v).approximate() * dy) /
        (dx * dx + dy * dy);
    ASSERT_GE(growth, bounds.growth * (1 - 1e-9)) << i;
    least_growth = std::min(least_growth, growth / bounds.growth);
    const auto value = stage_value(numbers, a[0], a[1]);
    const double error = std::max(std::abs((ArbBall(value.x) - at_a.x.v).approximate()),
                                  std::abs((ArbBall(value.y) - at_a.y.v).approximate()));
    ASSERT_LE(error, bounds.roundings * 0x1p-53 * bounds.terms) << i;
    greatest_error = std::max(greatest_error, error / (0x1p-53 * bounds.terms));
  }
  EXPECT_GT(known, 100);
  // The bounds say something.
  EXPECT_LT(least_growth, 1.1);
  EXPECT_GT(greatest_error, 0.2);
}

// The vectors of the fast engine sum the same terms in another order.
TEST_P(StageBoundsOf, ABoxHoldForResidualsOfVectors) {
  constexpr double u = 0x1p-53, focal_length = 640;
  double greatest_share = 0;
  for (int i = 0; i < 30; ++i) {
    const Lens lens = oracle::random_lens(random_, GetParam(), 0.2);
    const auto numbers = stage_of(lens);
    const double g = 1 / focal_length;
    const fast::PlaneForLanes plane{0, 0, {{{g, 0, 0}, {0, g, 0}, {0, 0, 1}}}, true};
    const double column = below(600) - 300, row = below(600) - 300;
    fast::BlockSamples found;
    fast::search_block(fast::StageForLanes(numbers), plane, column, row, column * g, row * g,
                       found);
    const StageBounds bounds =
        bounds_on_box(numbers, {Interval{found.left, found.right}, {found.top, found.bottom}});
    for (std::size_t k = 0; k < fast::BlockSamples::count; ++k) {
      ASSERT_LE(found.residual[k], found.greatest_residual);
      const auto S = oracle::distorted<ArbBall>(NamedParameters(lens), found.x[k], found.y[k]);
      const auto cell = static_cast<double>(k / 16), in_cell = static_cast<double>(k % 16);
      const double across = std::fmod(cell, 2) * 4 + std::fmod(in_cell, 4) + 0.5;
      const double down = std::floor(cell / 2) * 4 + std::floor(in_cell / 4) + 0.5;
      const double x = (S.x.v - ArbBall(column + across) * ArbBall(g)).approximate();
      const double y = (S.y.v - ArbBall(row + down) * ArbBall(g)).approximate();
      const double bound = std::sqrt(2) * u * (bounds.roundings * bounds.terms + 1);
      const double error = std::abs(std::hypot(x, y) - found.residual[k]);
      ASSERT_LE(error, bound + 4 * u * found.residual[k]) << i << ' ' << k;
      greatest_share = std::max(greatest_share, error / bound);
    }
  }
  EXPECT_GT(greatest_share, 0.002);
}

TEST_P(StageBoundsOf, OfACircleHoldForItsPoints) {
  double greatest_share = 0;
  for (int i = 0; i < 300; ++i) {
    const Lens lens = oracle::random_lens(random_, GetParam(), 0.5);
    const auto numbers = stage_of(lens);
    const double angle = number(-3.2, 3.2), radius = number(0.01, 1);
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    const auto S = stage_value(numbers, x, y);
    const double size = std::hypot(S.x, S.y), bound = greatest_on_circle(numbers, x * x + y * y);
    ASSERT_LE(size, bound * (1 + 1e-12));
    greatest_share = std::max(greatest_share, size / bound);
  }
  EXPECT_GT(greatest_share, 0.9);
}

}  // namespace
}  // namespace fathom::lens
