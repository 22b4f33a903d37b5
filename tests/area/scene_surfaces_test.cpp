// The index of triangles by place finds every pair that a look at all pairs does.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "fathom/area/surface_pairs.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace area;
using namespace triangle;
using checks::CaseMaker;
using checks::Kind;

void check(const Scene& scene, const Camera& camera, Cull cull, int& pairs) {
  const CoverageFrame frame{scene, camera, cull};
  const std::function<void(double)> nobody;
  Progress progress(nobody, 1);
  const SceneSurfaces surfaces(frame, progress);
  ASSERT_EQ(surfaces.count(), frame.triangles.count());
  for (std::uint32_t a = 0; a < surfaces.count(); ++a) {
    TierCounts counts;
    const auto t = project(frame.triangles.world_corners(a), a, camera, counts);
    const bool covers_nothing = t.orientation == Sign::zero || !is_kept(t, cull) ||
                                bounding_box(t, camera).is_empty() || !surface_region(t, camera);
    ASSERT_EQ(surfaces.surface(a) == nullptr, covers_nothing);
    if (covers_nothing) continue;
    EXPECT_EQ(surfaces.surface(a)->number, a);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t b = 0; b < surfaces.count(); ++b) {
      if (b == a || !surfaces.surface(b)) continue;
      const PixelBox &p = surfaces.box(a), &q = surfaces.box(b);
      bool meet = false;
      for (std::uint32_t row = p.first_row; row <= p.last_row && !meet; ++row) {
        for (std::uint32_t column = p.first_column; column <= p.last_column && !meet; ++column) {
          meet = q.contains(column, row);
        }
      }
      if (meet) expected.push_back(b);
    }
    ASSERT_EQ(surfaces.near(a), expected) << a;
    const auto depths_of = [&](std::uint32_t k) { return surfaces.surface(k)->depths; };
    std::vector<std::uint32_t> in_front = expected;
    std::erase_if(in_front,
                  [&](std::uint32_t other) { return depths_of(other).lower > depths_of(a).upper; });
    std::stable_sort(in_front.begin(), in_front.end(), [&](std::uint32_t i, std::uint32_t k) {
      return depths_of(i).lower < depths_of(k).lower;
    });
    ASSERT_EQ(surfaces.in_front(a), in_front) << a;
    pairs += static_cast<int>(expected.size());
  }
}

// Making surfaces takes about as long as finding pairs among them, which reports every 8 triangles.
TEST(SceneSurfaces, ReportsAsOftenAsItsUsers) {
  std::mt19937_64 random(163);
  const Scene scene = checks::soup(random, 1000, false);
  const Camera camera = checks::camera_of(160, 140, 64);
  double last = 0;
  int reports = 0;
  const std::function<void(double)> report = [&](double share) {
    last = share;
    ++reports;
  };
  Progress progress(report, SceneSurfaces::parts(1000));
  const SceneSurfaces surfaces({scene, camera, Cull::none}, progress);
  EXPECT_EQ(reports, 125);
  EXPECT_EQ(last, 1);
}

TEST(SceneSurfaces, NeighboursAreThoseWhoseBoxesMeet) {
  int pairs = 0;
  CaseMaker maker(161, Kind::few_bits);
  for (int i = 0; i < 100 && !HasFatalFailure(); ++i) {
    const checks::Case c = maker.make();
    check(c.scene, c.camera, i % 3 == 0 ? Cull::back : Cull::none, pairs);
  }
  std::mt19937_64 random(162);  // on several tiles of the index
  check(checks::soup(random, 40, true), checks::camera_of(160, 140, 64), Cull::none, pairs);
  EXPECT_GT(pairs, 500);
}

// Between two triangles, not only between two parts of thousands.
TEST(SurfaceParts, AreInterruptedWithinAPart) {
  std::atomic<bool> request{false};
  const Interruptible here(&request);
  SurfaceParts surfaces(SurfaceParts::triangles_per_part + 10);
  ASSERT_EQ(surfaces.size(), 2U);
  std::vector<std::uint32_t> asked_for;
  const auto surface_of = [&](std::uint32_t number) -> std::optional<SurfaceRegion> {
    asked_for.push_back(number);
    request = asked_for.size() == 3;
    return std::nullopt;
  };
  EXPECT_THROW(surfaces.make(1, surface_of), Interrupted);
  constexpr std::uint32_t first = SurfaceParts::triangles_per_part;
  EXPECT_EQ(asked_for, (std::vector<std::uint32_t>{first, first + 1, first + 2}));
}

}  // namespace
}  // namespace fathom
