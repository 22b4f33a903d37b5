// What is certain of depth and coverage is so in exact numbers, and mostly something is certain.
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::CaseMaker;
using checks::Kind;

Dyadic exactly(double x) {
  return x;
}
Dyadic exactly(const WordPair& x) {
  return Dyadic(x.hi) + Dyadic(x.lo);
}

struct Tally {
  int depths = 0, misses = 0, covers = 0, asked = 0, not_covered = 0, covered = 0;
};

/// Whether the bound holds; false where nothing is known.
template <class Real>
bool expect_within(const Certified<Real>& computed, const Ratio& exact) {
  if (!std::isfinite(computed.error)) return false;
  const Ratio error = Ratio(exactly(computed.value)) - exact;
  EXPECT_LE(compare(error, Ratio(Dyadic(computed.error))), 0);
  EXPECT_GE(compare(error, Ratio(Dyadic(-computed.error))), 0);
  return true;
}

void check(const checks::Case& c, Tally& tally) {
  const TriangleSource triangles(c.scene);
  const SceneRays rays(triangles, c.camera);
  CertifiedSurfaces surfaces(rays);
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    TierCounts counts;
    const ProjectedTriangle t = project(triangles.world_corners(number), number, c.camera, counts);
    if (t.orientation == Sign::zero) continue;
    for (std::uint32_t pixel = 0; pixel < c.camera.width * c.camera.height; ++pixel) {
      const ImagePoint s = centre_of_pixel(pixel % c.camera.width, pixel / c.camera.width);
      const bool is_covered = covers(t, s, counts);
      const bool in_front = is_covered && depth_at(t, s).sign() == Sign::positive;
      const bool misses = surfaces.certainly_misses(number, s);
      EXPECT_FALSE(misses && in_front);
      ++(in_front ? tally.covered : tally.not_covered);
      tally.misses += misses;
      if (!is_covered || in_front) {
        const bool covers_it = surfaces.certainly_covers(number, s);
        if (is_covered) tally.covers += covers_it;
        // Three positive weights where D ≤ 0 are no cover.
        if (covers_it && !is_covered) {
          EXPECT_NE(depth_at(t, s).sign(), Sign::positive);
        }
      }
      if (!in_front) continue;
      ++tally.asked;
      tally.depths += expect_within(surfaces.depth(number, s), depth_at(t, s));
      expect_within(surfaces.wide_depth(number, s), depth_at(t, s));
    }
  }
}

class Surfaces : public ::testing::TestWithParam<Kind> {};

TEST_P(Surfaces, SayOnlyWhatIsSo) {
  CaseMaker maker(111 + static_cast<std::uint64_t>(GetParam()), GetParam());
  Tally tally;
  for (int i = 0; i < 300 / checks::effort && !HasFailure(); ++i) check(maker.make(), tally);
  if (checks::effort > 1) return;
  EXPECT_GT(tally.covered, 2000);
  if (GetParam() != Kind::few_bits) return;
  EXPECT_GT(tally.depths, tally.asked * 9 / 10);
  EXPECT_GT(tally.misses, tally.not_covered / 2);
  EXPECT_GT(tally.covers, tally.covered / 2);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Surfaces,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge));

}  // namespace
}  // namespace fathom
