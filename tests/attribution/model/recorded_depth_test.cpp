#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "fathom/attribution/model/window_depth.h"
#include "tests/attribution/halfs.h"

namespace fathom::attribution {
namespace {

using Rounding = RecordedDepth::Rounding;
using test::nearest_half;

TEST(Binary16, KnownNumbers) {
  const std::array<std::pair<double, double>, 14> known{{{0, 0},
                                                         {1, 1},
                                                         {0.1, 0.0999755859375},
                                                         {1.0 / 3, 0.333251953125},
                                                         {65504, 65504},
                                                         {65503, 65504},
                                                         {0x1p-14, 0x1p-14},
                                                         {0x1p-24, 0x1p-24},
                                                         {0x1.8p-24, 0x1p-23},   // a tie
                                                         {0x1p-25, 0},           // a tie
                                                         {0x1.01p-25, 0x1p-24},  // above it
                                                         {2049, 2048},           // ties to even
                                                         {2051, 2052},
                                                         {-2051, -2052}}};
  for (const auto& [x, half] : known) {
    EXPECT_EQ(round_to_binary16(x), half) << x;
    EXPECT_EQ(nearest_half(x), half) << x;
  }
}

TEST(Binary16, AsATableHasThem) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-26, 15.99);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::exp2(exponent(random));
    ASSERT_EQ(round_to_binary16(x), nearest_half(x)) << x;
    ASSERT_EQ(round_to_binary16(-x), -nearest_half(x)) << x;
    const double half = nearest_half(x);
    ASSERT_EQ(round_to_binary16(half), half);
  }
}

TEST(Binary16, WhatHasNoneIsLeftAlone) {
  EXPECT_EQ(round_to_binary16(1e6), 1e6);
  EXPECT_EQ(round_to_binary16(std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(round_to_binary16(std::numeric_limits<double>::quiet_NaN())));
}

TEST(RecordedDepth, RoundsToItsSteps) {
  RecordedDepth r{.rounding = Rounding::nearest, .step = 0.25};
  EXPECT_EQ(r.rounded(1.1), 1);
  EXPECT_EQ(r.rounded(1.2), 1.25);
  EXPECT_EQ(r.step_at(1.2), 0.25);
  r.origin = 0.1;
  EXPECT_DOUBLE_EQ(r.rounded(1.2), 1.1);
  r.rounding = Rounding::down;
  EXPECT_DOUBLE_EQ(r.rounded(1.34), 1.1);
  EXPECT_DOUBLE_EQ(r.rounded(-0.1), -0.15);
  r.rounding = Rounding::binary16;
  EXPECT_EQ(r.rounded(2049), 2048);
  EXPECT_EQ(r.step_at(2050), 2);
  r.rounding = Rounding::binary32;
  EXPECT_EQ(r.rounded(1.2), 1.2);
  EXPECT_EQ(r.step_at(1.2), 0x1p-23);
}

TEST(RecordedDepth, TermsAndDepths) {
  for (const DepthTerm term : {DepthTerm::depth, DepthTerm::inverse, DepthTerm::logarithm}) {
    EXPECT_NEAR(depth_of(term, term_of(term, 3.7)), 3.7, 1e-15);
  }
  EXPECT_EQ(term_of(DepthTerm::inverse, 4), 0.25);
  EXPECT_EQ(term_of(DepthTerm::logarithm, 1), 0);
  EXPECT_EQ(depth_of(DepthTerm::inverse, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(depth_of(DepthTerm::inverse, -1), std::numeric_limits<double>::infinity());
}

// A window depth of near 0.5 and far 20, one that decreases with the depth, and others.
struct Recording {
  const char* name;
  RecordedDepth recorded;
};
const std::array recordings{
    Recording{"Millimetres", {.factor = 1000, .rounding = Rounding::nearest, .step = 1}},
    Recording{"RoundedDown", {.factor = 1000, .rounding = Rounding::down, .step = 1}},
    Recording{"Half", {.rounding = Rounding::binary16}},
    Recording{"Single", {.factor = 0.3, .offset = 2}},
    Recording{"Window16",
              {DepthTerm::inverse, -10 / 19.5, 20 / 19.5, Rounding::nearest, 0, 1 / 65535.0}},
    Recording{"Disparity8", {DepthTerm::inverse, 0.5, 0, Rounding::nearest, 0, 1 / 255.0}},
    Recording{"Logarithm", {DepthTerm::logarithm, -0.27, 1.2, Rounding::down, 0.0001, 1 / 4095.0}},
    Recording{"NegativeHalf", {.factor = -1, .rounding = Rounding::binary16}}};

void PrintTo(const Recording& r, std::ostream* stream) {
  *stream << r.name;
}

class Recorded : public testing::TestWithParam<Recording> {};

/// What is written by the text book: independent of rounded().
double written(const RecordedDepth& r, double exact) {
  switch (r.rounding) {
    case Rounding::binary32:
      return double{static_cast<float>(exact)};
    case Rounding::binary16:
      return nearest_half(exact);
    case Rounding::nearest:
    case Rounding::down:
      break;
  }
  double k = std::floor((exact - r.origin) / r.step);
  if (r.rounding == Rounding::nearest && (exact - r.origin) / r.step - k > 0.5) ++k;
  return double{static_cast<float>(r.origin + k * r.step)};
}

TEST_P(Recorded, WhatIsReadBackIsInTheInterval) {
  const RecordedDepth& r = GetParam().recorded;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> logarithm(std::log(0.5), std::log(20));
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const double least = std::exp(logarithm(random));
    const double greatest = least * (1 + 1e-3 * part(random) * part(random));
    const double depth = least + part(random) * (greatest - least);
    const double stored = written(r, r.exact(depth));
    const double read = r.to_depth(stored);
    const Interval interval = r.read_back({least, greatest});
    ASSERT_LE(interval.lower, read) << depth;
    ASSERT_GE(interval.upper, read) << depth;
    // Not wider than a step on either side, and the roundings.
    const double most = 1.001 * r.step_at(stored) + 1e-6 * (std::abs(r.exact(depth)) + 1) +
                        std::abs(r.exact(greatest) - r.exact(least));
    if (!std::isfinite(interval.upper)) continue;
    ASSERT_LE(std::abs(r.exact(interval.upper) - r.exact(depth)), most) << depth;
    ASSERT_LE(std::abs(r.exact(interval.lower) - r.exact(depth)), most) << depth;
  }
}

TEST_P(Recorded, AnErrorWidensTheInterval) {
  RecordedDepth r = GetParam().recorded;
  const Interval before = r.read_back({3, 3});
  r.error = 3 * r.step_at(r.exact(3));
  const Interval after = r.read_back({3, 3});
  EXPECT_LT(after.lower, before.lower);
  EXPECT_GT(after.upper, before.upper);
}

INSTANTIATE_TEST_SUITE_P(All, Recorded, testing::ValuesIn(recordings),
                         [](const auto& r) { return std::string(r.param.name); });

}  // namespace
}  // namespace fathom::attribution
