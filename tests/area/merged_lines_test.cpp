// Equal half-planes are one object, others are not.
#include <gtest/gtest.h>

#include <deque>

#include "fathom/area/convex_polygon.h"

namespace fathom {
namespace {

using namespace area;

TEST(MergedLines, AreOneIfTheyHaveTheSamePoints) {
  std::deque<HalfPlane> lines;
  const auto add = [&](double a, double b, double c, const Dyadic& factor) -> const HalfPlane& {
    return lines.emplace_back(ExactVector3{a * factor, b * factor, c * factor});
  };
  const Dyadic third_of_much = Dyadic(0x1.8p300) + Dyadic(1.0);
  MergedLines merged;
  const HalfPlane& first = merged.of(add(1, -2, 0.5, 1.0));
  EXPECT_EQ(&merged.of(add(1, -2, 0.5, 3.0)), &first);
  EXPECT_EQ(&merged.of(add(1, -2, 0.5, 0x1p-1000)), &first);
  EXPECT_EQ(&merged.of(add(1, -2, 0.5, third_of_much)), &first);
  EXPECT_EQ(&merged.of(first), &first);
  EXPECT_NE(&merged.of(add(1, -2, 0.5, -1.0)), &first);
  EXPECT_NE(&merged.of(add(1, -2, 0.5000000000000001, 1.0)), &first);
  EXPECT_NE(&merged.of(add(1, 2, 0.5, 1.0)), &first);
  EXPECT_EQ(&merged.of(add(0, 6, 0, 1.0)), &merged.of(add(0, 7, 0, 1.0)));
}

TEST(MergedLines, HaveAnOppositeEach) {
  const HalfPlane line({3.0, -6.0, 1.5});
  const HalfPlane other({-2.0, 4.0, -1.0});
  MergedLines merged;
  EXPECT_EQ(&merged.opposite(line), &merged.of(other));
  EXPECT_EQ(&merged.opposite(other), &merged.of(line));
  EXPECT_EQ(&merged.opposite(merged.opposite(line)), &merged.of(line));
}

}  // namespace
}  // namespace fathom
