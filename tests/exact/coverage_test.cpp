// Channel A against areas computed in slabs by rational numbers, and against areas known on paper.
#include "fathom/exact/coverage.h"

#include <gtest/gtest.h>

#include <numeric>

#include "fathom/exact/probe.h"
#include "fathom/numeric/rounding.h"
#include "tests/exact/against_oracle.h"
#include "tests/exact/effort.h"
#include "tests/exact/random_scenes.h"
#include "tests/exact/tested_engine.h"

namespace fathom {
namespace {

using oracle::Q;
using testing::camera_of;
using testing::Case;
using testing::CaseMaker;
using testing::Kind;
using testing::scene_of;

RenderOptions only_coverage() {
  RenderOptions options;
  options.channels = {Channel::A};
  options.threads = 1;
  return options;
}

Samples<float> coverage_of(const Scene& scene, const Camera& camera,
                           const RenderOptions& options = only_coverage()) {
  return *testing::render_tested(scene, camera, options).values<float>("A");
}

std::vector<std::uint32_t> all_triangles(const Scene& scene) {
  std::vector<std::uint32_t> numbers(triangle_count(scene));
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

struct Tally {
  int partly = 0, full = 0, empty = 0;
};

void check(const Case& c, Tally& tally) {
  const Samples<float> A = coverage_of(c.scene, c.camera);
  const oracle::Areas areas = testing::areas_at(c.scene, c.camera);
  const CoverageFrame frame{c.scene, c.camera};
  const std::vector<std::uint32_t> triangles = all_triangles(c.scene);
  for (std::uint32_t y = 0; y < c.camera.height; ++y) {
    for (std::uint32_t x = 0; x < c.camera.width; ++x) {
      SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
      const Q expected = areas.coverage(static_cast<int>(x), static_cast<int>(y));
      ASSERT_EQ(testing::rational(pixel_coverage(frame, triangles, x, y)), expected);
      ASSERT_EQ(A[y * c.camera.width + x], testing::nearest_float(expected));
      ++(sgn(expected) == 0 ? tally.empty : expected == 1 ? tally.full : tally.partly);
    }
  }
}

class Coverage : public ::testing::TestWithParam<Kind> {};

TEST_P(Coverage, IsTheAreaOfTheUnion) {
  CaseMaker maker(77 + static_cast<std::uint64_t>(GetParam()), GetParam());
  Tally tally;
  for (int i = 0; i < 150 / testing::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(), tally);
  }
  if (testing::effort > 1) return;
  EXPECT_GT(tally.partly, 500);
  EXPECT_GT(tally.full, 50);
  EXPECT_GT(tally.empty, 500);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Coverage,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge,
                                           Kind::tiny));

}  // namespace
}  // namespace fathom
