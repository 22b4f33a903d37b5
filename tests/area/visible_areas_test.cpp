// Visible and unoccluded areas of triangles and objects against the sum over pixels of the
// oracle's.
#include "fathom/area/visible_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fathom/area/coplanar.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

using checks::Case;
using checks::CaseMaker;
using checks::Kind;
using oracle::Q;

double nearest(const Q& q) {
  return oracle::quotient(oracle::binary64, q.get_mpq_t());
}

struct Truth {
  std::vector<Q> visible, unoccluded;
};

Truth truth_of(const Scene& scene, const Camera& camera) {
  const oracle::Areas areas = checks::areas_at(scene, camera);
  const auto count = static_cast<std::uint32_t>(triangle_count(scene));
  Truth truth{std::vector<Q>(count), std::vector<Q>(count)};
  for (int y = 0; y < static_cast<int>(camera.height); ++y) {
    for (int x = 0; x < static_cast<int>(camera.width); ++x) {
      for (const auto& [number, area] : areas.visible(x, y)) truth.visible[number] += area;
      for (std::uint32_t t = 0; t < count; ++t) {
        truth.unoccluded[t] += areas.unoccluded(t, x, y);
      }
    }
  }
  return truth;
}

void expect_area(const VisibleArea& found, const Q& visible, const Q& unoccluded) {
  EXPECT_EQ(found.visible, nearest(visible));
  EXPECT_EQ(found.unoccluded, nearest(unoccluded));
  ASSERT_EQ(found.ratio.has_value(), sgn(unoccluded) != 0);
  if (found.ratio) {
    EXPECT_EQ(*found.ratio, nearest(visible / unoccluded));
  }
}

/// The scene with its triangles dealt out to two objects of one mesh each.
Scene in_two_objects(const Scene& scene) {
  Scene two = scene;
  two.meshes.push_back(scene.meshes[0]);
  two.objects.push_back({.mesh = 1, .name = "second"});
  auto& first = two.meshes[0].triangles;
  const std::size_t half = first.size() / 2;
  two.meshes[1].triangles.assign(first.begin() + static_cast<std::ptrdiff_t>(half), first.end());
  first.resize(half);
  return two;
}

Scene only_object(const Scene& scene, std::size_t object) {
  Scene one = scene;
  one.meshes[1 - object].triangles.clear();
  return one;
}

TEST(VisibleAreas, AreTheOraclesSumsRoundedOnce) {
  int partly = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours}) {
    CaseMaker maker(616 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 60 / checks::effort && !HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Case c = maker.make();
      const Scene scene = in_two_objects(c.scene);
      const Truth truth = truth_of(scene, c.camera);
      const VisibleAreas found = visible_areas(scene, c.camera, {.threads = 1});
      ASSERT_EQ(found.triangles.size(), truth.visible.size());
      Q of_object[2];
      for (std::uint32_t t = 0; t < truth.visible.size(); ++t) {
        SCOPED_TRACE("triangle " + std::to_string(t));
        expect_area(found.triangles[t], truth.visible[t], truth.unoccluded[t]);
        of_object[origin_of(scene, t).object] += truth.visible[t];
        partly += sgn(truth.visible[t]) > 0 && truth.visible[t] < truth.unoccluded[t];
      }
      ASSERT_EQ(found.objects.size(), 2U);
      for (std::size_t object = 0; object < 2; ++object) {
        SCOPED_TRACE("object " + std::to_string(object));
        Q alone = 0;
        for (const Q& area : truth_of(only_object(scene, object), c.camera).visible) alone += area;
        expect_area(found.objects[object], of_object[object], alone);
      }
    }
  }
  if (checks::effort > 1) return;
  EXPECT_GT(partly, 20);
}

// Two triangles make a rectangle of width w whose diagonal leaves the image at w/3: the areas are
// no binary fractions, their sum w lies in the middle between two binary64 numbers.
TEST(VisibleAreas, SumsInTheMiddleAreRoundedToEven) {
  Camera camera = checks::camera_of(2, 1, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  const double left = 0x1p-53;
  for (const auto& [right, expected] : {std::pair(1 + 0x1p-52, 1.0),  // w = 1 + 2⁻⁵³
                                        std::pair(1 + 0x1p-51, 1 + 0x1p-51)}) {  // 1 + 3·2⁻⁵³
    const Scene scene = checks::scene_of({{left, 0, 1}, {right, 0, 1}, {right, 3, 1}, {left, 3, 1}},
                                         {{0, 1, 2}, {0, 2, 3}});
    const VisibleAreas found = visible_areas(scene, camera, {});
    EXPECT_EQ(found.objects[0].visible, expected);
    EXPECT_EQ(found.objects[0].unoccluded, expected);
    EXPECT_EQ(found.objects[0].ratio, 1.0);
  }
}

/// Also of the part before the first area, which of a million triangles lasts for minutes.
TEST(VisibleAreas, ProgressIsReportedFromTheBeginning) {
  constexpr std::uint32_t count = 20'000;
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{0, 0, 1}, {1, 0, 2}, {2, 0, 3}};  // seen edge on
  scene.meshes[0].triangles.assign(count, {0, 1, 2});
  scene.objects.emplace_back();
  std::vector<double> shares;
  RenderOptions options;
  options.threads = 1;
  const auto progress = [&](double share) { shares.push_back(share); };
  visible_areas(scene, checks::camera_of(4, 4, 2), options, progress);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
  // Transforming, numbering and classifying are most of the work where little is visible.
  const std::size_t chunks = count / 4096, areas = 64, unoccluded = count / 64 / 64 + 1;
  EXPECT_EQ(shares.size(), 3 * chunks + 1 + areas + unoccluded);
  shares.clear();
  coplanar_pairs(scene, checks::camera_of(4, 4, 2), 0, options, progress);
  EXPECT_EQ(shares.back(), 1);
  EXPECT_EQ(shares.size(), count / 8 + (count / 8 + 1)) << "as many for surfaces as for pairs";
}

}  // namespace
}  // namespace fathom
