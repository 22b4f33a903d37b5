#include "fathom/rays/cast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adversaries.h"
#include "tests/engines/only_target.h"
#include "tests/rays/rational_rays.h"
#include "tests/rays/ray_cases.h"

namespace fathom::rays {
namespace {

std::string text_of(const Ray& ray) {
  std::string text = "Ray{{";
  for (std::size_t k = 0; k < 6; ++k) {
    char number[64];
    std::snprintf(number, sizeof number, "%s%a",
                  k == 3  ? "}, {"
                  : k > 0 ? ", "
                          : "",
                  k < 3 ? ray.origin[k] : ray.direction[k - 3]);
    text += number;
  }
  return text + "}}";
}

/// Every question about every ray, against brute force in rational numbers.
void expect_as_by_rationals(const test::RayCase& all) {
  const RayScene scene(all.scene);
  const auto triangles = test::rational_triangles(all.scene);
  const auto nearest = cast(scene, all.rays, all.options);
  const auto is_hit = occluded(scene, all.rays, all.options);
  const auto counts = count_hits(scene, all.rays, all.options);
  const auto lists = all_hits(scene, all.rays, all.options);
  ASSERT_EQ(lists.splits.size(), all.rays.size() + 1);
  for (std::size_t i = 0; i < all.rays.size(); ++i) {
    SCOPED_TRACE(text_of(all.rays[i]));
    const auto expected = oracle::hits_of(test::rational_ray(all.rays[i]), triangles,
                                          test::rational_stretch(all.options));
    EXPECT_EQ(is_hit[i], !expected.empty());
    EXPECT_EQ(counts[i], expected.size());
    ASSERT_EQ(lists.splits[i + 1] - lists.splits[i], expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const RayHit& hit = lists.hits[lists.splits[i] + k];
      EXPECT_EQ(hit.triangle, expected[k].triangle);
      EXPECT_TRUE(test::is_same(hit.t, test::rounded(expected[k].t)));
    }
    if (expected.empty()) {
      EXPECT_EQ(nearest[i], RayHit{});
    } else {
      EXPECT_EQ(nearest[i].triangle, expected[0].triangle);
      EXPECT_TRUE(test::is_same(nearest[i].t, test::rounded(expected[0].t)));
    }
  }
}

class RayAdversaries : public ::testing::TestWithParam<test::Family> {};

TEST_P(RayAdversaries, MeetWhatTheyMeetInRationalNumbers) {
  checks::for_each_adversary(
      60, [&](std::uint64_t seed) { expect_as_by_rationals(GetParam().draw(seed)); });
}

TEST_P(RayAdversaries, MeetTheSameWithAllVectorInstructions) {
  for (const std::int64_t target : checks::vector_targets()) {
    const checks::OnlyTarget only(target);
    checks::for_each_adversary(
        2, [&](std::uint64_t seed) { expect_as_by_rationals(GetParam().draw(1000 + seed)); });
  }
}

INSTANTIATE_TEST_SUITE_P(Families, RayAdversaries, ::testing::ValuesIn(test::families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace fathom::rays
