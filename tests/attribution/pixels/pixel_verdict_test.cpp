#include <gtest/gtest.h>

#include <vector>

#include "fathom/attribution/pixels/pixel_judge.h"
#include "fathom/attribution/truth.h"
#include "tests/special_values.h"

/// What fragments allow together: a square of two triangles, the sample near their diagonal.
namespace fathom::attribution {
namespace {

// 0 1    the triangles 0 1 2 and 1 3 2 share the edge from 1 to 2
// 2 3
const std::vector<CornerIndices> triangles{{0, 1, 2}, {1, 3, 2}};
const std::vector<std::uint32_t> numbers{0, 1, 2, 3};

Fragment certain(double lower, double upper) {
  return {.coverage = Coverage::must, .inside = true, .value = {lower, upper}};
}

/// Open at the diagonal, which is opposite corner 0 of the first and corner 1 of the second.
Fragment open(std::uint32_t triangle, bool inside, double upper) {
  return {.triangle = triangle,
          .coverage = Coverage::may,
          .open_edges = static_cast<std::uint8_t>(1U << triangle),
          .inside = inside,
          .value = {0, upper}};
}

PixelVerdict verdict(const std::vector<Fragment>& fragments, bool watertight) {
  return verdict_of(fragments, watertight, triangles, numbers);
}

TEST(PixelVerdict, NothingNeedBeSeenWhereNothingIsCertain) {
  for (const auto& fragments : {std::vector<Fragment>{}, {open(0, true, 0.5)}}) {
    const PixelVerdict v = verdict(fragments, true);
    EXPECT_FALSE(v.must);
    EXPECT_FALSE(v.must_if_watertight);
    EXPECT_EQ(v.cap, infinity);
  }
}

TEST(PixelVerdict, TheNearestCertainFragmentIsTheLimit) {
  const PixelVerdict v = verdict({certain(0.4, 0.6), certain(0.2, 0.3), certain(0.7, 0.8)}, false);
  EXPECT_TRUE(v.must);
  EXPECT_EQ(v.cap, 0.3);
}

TEST(PixelVerdict, TwoThatShareTheirOpenEdgeAreCertainTogether) {
  const std::vector<Fragment> both{open(0, true, 0.4), open(1, false, 0.5)};
  const PixelVerdict v = verdict(both, true);
  EXPECT_TRUE(v.must);
  EXPECT_EQ(v.cap, 0.5);  // either of them may be the one
  const PixelVerdict leaking = verdict(both, false);
  EXPECT_FALSE(leaking.must);
  EXPECT_TRUE(leaking.must_if_watertight);
  EXPECT_EQ(leaking.cap, infinity);
}

TEST(PixelVerdict, OutsideBothNothingIsCertain) {
  EXPECT_FALSE(verdict({open(0, false, 0.4), open(1, false, 0.5)}, true).must_if_watertight);
}

TEST(CornerNumbers, PointsAtOnePlaceAreOne) {
  WorldMesh mesh;
  mesh.points = {{0, 0, 1}, {1, 0, 0}, {-0.0, 0, 1}, {1, 0, 0x1p-1074}, {1, 0, 0}};
  EXPECT_EQ(corner_numbers(mesh), (std::vector<std::uint32_t>{0, 1, 0, 3, 1}));
}

}  // namespace
}  // namespace fathom::attribution
