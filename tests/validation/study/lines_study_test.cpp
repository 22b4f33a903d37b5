// The figures of the study `lines`, by arithmetic of the test's own.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/study/lines/lines.h"

namespace fathom::studies {
namespace {

TEST(LinesStudy, DecisionsOfTheTextbooksLine) {
  // 3x/8 is 0, .375, .75, 1.125, 1.5 (a tie: up), 1.875, 2.25, 2.625, 3.
  const std::vector<double> rows{0, 0, 1, 1, 2, 2, 2, 3, 3};
  const std::vector<DecidedLine> lines = decided_lines();
  ASSERT_EQ(lines.size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(lines[i].rows, rows) << lines[i].algorithm;
  EXPECT_EQ(lines[0].decisions, "y: 0 0.375 0.75 1.125 1.5 1.875 2.25 2.625 3");
  EXPECT_EQ(lines[1].decisions, "y: 0 0.375 0.75 1.125 1.5 1.875 2.25 2.625 3");
  // 2(3x − 8y) for the pixels above, and that + 2·3 − 8.
  EXPECT_EQ(lines[2].decisions, "error: 0 6 -4 2 -8 -2 4 -6 0");
  EXPECT_EQ(lines[3].decisions, "d: -2 4 -6 0 -10 -4 2 -8 -2");
  // From centre to centre the last diamond is entered and not left.
  EXPECT_EQ(lines[5].rows, std::vector<double>(rows.begin(), rows.end() - 1));
  // The textbook's program stays at the tie: (4, 1).
  EXPECT_EQ(lines[4].rows, (std::vector<double>{0, 0, 1, 1, 1, 2, 2, 3, 3}));
}

TEST(LinesStudy, EveryWayToMeasureAStepDrawsTheLine) {
  // m = 1/4: no sum is rounded.
  std::int64_t rows = 0;
  for (std::int64_t i = 0; i < 400; ++i) rows += (i + 2) / 4;
  EXPECT_EQ(rows_by_products(400, 0.25), rows);
  EXPECT_EQ(rows_by_sums(400, 0.25), rows);
  EXPECT_EQ(rows_by_four_sums(400, 0.25F), rows);
  const std::vector<StepCost> costs = step_costs();
  ASSERT_EQ(costs.size(), 3u);
  for (const StepCost& cost : costs) EXPECT_GT(std::min(cost.binary32_ns, cost.binary64_ns), 0);
}

/// A line by sums or by products, rounded to Number, judged in integers.
template <class Number>
LineDrift drift_of(bool by_sums, std::int64_t length, std::uint32_t slopes) {
  LineDrift drift{"", length};
  std::mt19937_64 random(42);
  for (std::uint32_t i = 0; i < slopes; ++i) {
    const auto dy = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(length + 1));
    const Number m = static_cast<Number>(dy) / static_cast<Number>(length);
    Number sum = 0;
    for (std::int64_t x = 0; x <= length; ++x, sum += m) {
      const Number y = by_sums ? sum : m * static_cast<Number>(x);
      const Number below = std::floor(y);
      const auto drawn = static_cast<std::int64_t>(below) + (y - below >= Number(0.5) ? 1 : 0);
      // The nearest row r: 2r·length ≤ 2·x·dy + length < 2(r + 1)·length.
      const std::int64_t place = 2 * x * dy + length;
      const bool right = 2 * drawn * length <= place && place < 2 * (drawn + 1) * length;
      ++drift.pixels;
      drift.wrong += !right;
      drift.wrong_at_ties += !right && place % (2 * length) == 0;
      drift.greatest = std::max(
          drift.greatest, std::abs(static_cast<double>(y) -
                                   static_cast<double>(x * dy) / static_cast<double>(length)));
    }
  }
  return drift;
}

TEST(LinesStudy, DriftsAreThoseOfSumsAndProducts) {
  for (const std::int64_t length : {100, 3001}) {
    const std::vector<LineDrift> drifts = measure_drift(length, 40);
    ASSERT_EQ(drifts.size(), 4u);
    const LineDrift own[] = {drift_of<float>(true, length, 40), drift_of<float>(false, length, 40),
                             drift_of<double>(true, length, 40),
                             drift_of<double>(false, length, 40)};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(drifts[i].length, length);
      EXPECT_EQ(drifts[i].pixels, own[i].pixels);
      EXPECT_EQ(drifts[i].wrong, own[i].wrong) << drifts[i].algorithm;
      EXPECT_EQ(drifts[i].wrong_at_ties, own[i].wrong_at_ties) << drifts[i].algorithm;
      EXPECT_EQ(drifts[i].greatest, own[i].greatest) << drifts[i].algorithm;
    }
    EXPECT_GT(drifts[0].wrong, 0u);  // binary32 sums drift
  }
}

TEST(LinesStudy, NothingDriftsWhereEverySumIsExact) {
  for (const LineDrift& drift : measure_drift(1024, 50)) {
    EXPECT_EQ(drift.pixels, 50u * 1025);
    EXPECT_EQ(drift.wrong, 0u) << drift.algorithm;
    EXPECT_EQ(drift.greatest, 0) << drift.algorithm;
  }
}

}  // namespace
}  // namespace fathom::studies
