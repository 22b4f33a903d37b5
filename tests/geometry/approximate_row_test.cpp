#include "fathom/geometry/approximate_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/numeric/random_numbers.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

Dyadic exact_at(const std::array<Dyadic, 4>& row, const MeshPoint& p) {
  return row[0] * Dyadic(p.x) + row[1] * Dyadic(p.y) + row[2] * Dyadic(p.z) + row[3];
}

TEST(ApproximateRow, IntervalsContainTheExactValue) {
  checks::Numbers n(81);
  int narrow = 0;
  constexpr int rounds = 20000;
  for (int i = 0; i < rounds; ++i) {
    std::array<Dyadic, 4> row;
    for (Dyadic& x : row) x = Dyadic(n.wild(60)) + Dyadic(n.wild(60)) * Dyadic(0x1p-50);
    MeshPoint p{n.wild(60), n.wild(60), n.wild(60)};
    // Every other value nearly vanishes, where all that is left is the error.
    if (i % 2 == 0) row[3] = Dyadic(n.unit()) * Dyadic(0x1p-60) - exact_at(row, p) + row[3];
    const Interval hull = ApproximateRow(row).at(p);
    const Dyadic exact = exact_at(row, p);
    ASSERT_LE(compare(Dyadic(hull.lower), exact), 0);
    ASSERT_GE(compare(Dyadic(hull.upper), exact), 0);
    double size = std::abs(enclose(row[3]).lower);
    const double entries[] = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) size += std::abs(enclose(row[k]).lower * entries[k]);
    narrow += hull.upper - hull.lower <= size * 0x1p-47 + 0x1p-1060;
  }
  EXPECT_EQ(narrow, rounds);
}

TEST(ApproximateRow, NothingIsKnownOfMagnitudesWithoutABound) {
  const auto is_line = [](const Interval& x) {
    return x.lower == -infinity && x.upper == infinity;
  };
  const MeshPoint one{1, 1, 1};
  EXPECT_TRUE(is_line(ApproximateRow({0x1p-1030, 1.0, 1.0, 1.0}).at(one)));  // subnormal
  EXPECT_TRUE(is_line(
      ApproximateRow({Dyadic(1e300) * Dyadic(1e300), 1.0, 1.0, 1.0}).at(one)));  // too large
  EXPECT_TRUE(is_line(ApproximateRow({1e300, 1.0, 1.0, 1.0}).at({1e300, 1, 1})));
  EXPECT_FALSE(is_line(ApproximateRow({0.0, 0.0, 0.0, 0.0}).at(one)));
}

}  // namespace
}  // namespace fathom
