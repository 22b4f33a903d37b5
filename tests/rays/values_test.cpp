#include <gtest/gtest.h>

#include <type_traits>

#include "fathom/failures/errors.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/hit_values.h"
#include "tests/adversaries.h"
#include "tests/inputs/scene_building.h"
#include "tests/oracle/mpfr_rounding.h"
#include "tests/rays/rational_rays.h"
#include "tests/rays/ray_cases.h"

namespace fathom::rays {
namespace {

using oracle::Q;

template <class Real>
constexpr oracle::Range range_of =
    std::is_same_v<Real, float> ? oracle::binary32 : oracle::binary64;

template <class Real>
void expect_rounded(Real value, const Q& exact) {
  EXPECT_TRUE(test::is_same(value, oracle::quotient(range_of<Real>, exact.get_mpq_t())));
}

/// The value is √squared with this sign.
template <class Real>
void expect_root(Real value, const Q& squared, int sign) {
  const double root = oracle::root(range_of<Real>, squared.get_mpq_t());
  EXPECT_TRUE(test::is_same(value, sign < 0 ? -root : root));
}

template <class Real>
void expect_values(const Scene& scene, const Ray& ray, const oracle::RayHit& hit) {
  const HitValues<Real> values = hit_values<Real>(scene, ray, hit.triangle);
  expect_rounded(values.t, hit.t);
  Q squared_length = 0, squared_normal = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    squared_length += Q(ray.direction[k]) * Q(ray.direction[k]);
    squared_normal += hit.normal[k] * hit.normal[k];
  }
  expect_root(values.distance, hit.t * hit.t * squared_length, sgn(hit.t));
  for (std::size_t k = 0; k < 3; ++k) {
    expect_rounded(values.position[k], hit.point[k]);
    expect_root(values.normal[k], hit.normal[k] * hit.normal[k] / squared_normal,
                sgn(hit.normal[k]));
  }
  expect_rounded(values.barycentric[0], hit.weight_b);
  expect_rounded(values.barycentric[1], hit.weight_c);
}

class RayValueAdversaries : public ::testing::TestWithParam<test::Family> {};

TEST_P(RayValueAdversaries, AreRationalNumbersRoundedOnce) {
  checks::for_each_adversary(5, [&](std::uint64_t seed) {
    const test::RayCase all = GetParam().draw(seed);
    const auto triangles = test::rational_triangles(all.scene);
    for (const Ray& ray : all.rays) {
      const auto hits =
          oracle::hits_of(test::rational_ray(ray), triangles, test::rational_stretch(all.options));
      for (std::size_t i = 0; i < std::min<std::size_t>(hits.size(), 2); ++i) {
        expect_values<float>(all.scene, ray, hits[i]);
        expect_values<double>(all.scene, ray, hits[i]);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, RayValueAdversaries, ::testing::ValuesIn(test::families()),
                         [](const auto& family) { return family.param.name; });

TEST(HitValues, AreThoseOnPaper) {
  const Scene scene = checks::scene_of({{0, 0, 4}, {4, 0, 4}, {0, 4, 4}}, {{0, 1, 2}});
  const auto values = hit_values<double>(scene, {{1, 2, 0}, {0, 0, 2}}, 0);
  EXPECT_EQ(values.t, 2);
  EXPECT_EQ(values.distance, 4);
  EXPECT_EQ(values.position, (std::array<double, 3>{1, 2, 4}));
  EXPECT_EQ(values.barycentric, (std::array<double, 2>{0.25, 0.5}));
  EXPECT_EQ(values.normal, (std::array<double, 3>{0, 0, -1}));
  EXPECT_FALSE(values.front_facing);
  EXPECT_TRUE(hit_values<double>(scene, {{1, 2, 9}, {0, 0, -2}}, 0).front_facing);
}

TEST(HitValues, OfManyHitsAreThoseOfEach) {
  const Scene scene = checks::scene_of({{0, 0, 4}, {4, 0, 4}, {0, 4, 4}}, {{0, 1, 2}});
  const std::vector<Ray> rays{
      {{1, 2, 0}, {0, 0, 2}}, {{9, 9, 0}, {0, 0, 1}}, {{1, 1, 9}, {0, 0, -1}}};
  const std::vector<std::uint32_t> met{0, no_triangle, 0};
  for (const int threads : {0, 1}) {
    const auto values = hit_values<float>(scene, rays, met, threads);
    ASSERT_EQ(values.size(), 3U);
    EXPECT_EQ(values[0].position, (std::array<float, 3>{1, 2, 4}));
    EXPECT_EQ(values[1].t, std::numeric_limits<float>::infinity());
    EXPECT_EQ(values[2].t, 5);
    EXPECT_TRUE(values[2].front_facing && !values[1].front_facing);
  }
  const std::vector<std::uint32_t> not_met{0, 0, 0};
  EXPECT_THROW(hit_values<float>(scene, rays, not_met), UsageError);
}

TEST(HitValues, RefuseATriangleThatIsNotMet) {
  const Scene scene = checks::scene_of({{0, 0, 4}, {4, 0, 4}, {0, 4, 4}}, {{0, 1, 2}});
  EXPECT_THROW(hit_values<float>(scene, {{9, 9, 0}, {0, 0, 2}}, 0), UsageError);
  EXPECT_THROW(hit_values<float>(scene, {{1, 1, 0}, {0, 0, 2}}, 1), std::out_of_range);
}

}  // namespace
}  // namespace fathom::rays
