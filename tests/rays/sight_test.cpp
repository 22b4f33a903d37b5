#include "fathom/rays/sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fathom/failures/errors.h"
#include "tests/adversaries.h"
#include "tests/engines/only_target.h"
#include "tests/inputs/scene_building.h"
#include "tests/oracle/generic_rays.h"
#include "tests/oracle/sight.h"
#include "tests/rays/rational_rays.h"
#include "tests/rays/sight_cases.h"

namespace fathom::rays {
namespace {

using Point = std::array<double, 3>;

struct Ends {
  std::vector<SightPoint> eyes, points;
};

Ends ends_of(const std::vector<std::pair<SightPoint, SightPoint>>& pairs) {
  Ends ends;
  for (const auto& [eye, point] : pairs) {
    ends.eyes.push_back(eye);
    ends.points.push_back(point);
  }
  return ends;
}

/// The first triangles twice, so that much coincides.
void repeat_some_triangles(Scene& scene) {
  auto triangles = std::vector<CornerIndices>(scene.meshes[0].triangles.begin(),
                                              scene.meshes[0].triangles.end());
  const std::size_t count = std::min<std::size_t>(triangles.size(), 4);
  for (std::size_t i = 0; i < count; ++i) triangles.push_back(triangles[i]);
  scene.meshes[0].triangles = std::move(triangles);
}

bool is_open(const oracle::Vector& eye, const oracle::Vector& point,
             const std::vector<oracle::Triangle>& triangles) {
  const oracle::Vector way{point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]};
  return oracle::hits_of({eye, way}, triangles, {.last = oracle::Q(1), .open = true}).empty();
}

/// Both rules for edges, against brute force in rational numbers.
void expect_as_by_rationals(test::RayCase all, std::uint64_t seed) {
  if (seed % 3 == 0) repeat_some_triangles(all.scene);
  const auto pairs = test::draw_pairs(all, seed);
  const auto [eyes, points] = ends_of(pairs);
  const RayScene scene(all.scene);
  const auto triangles = test::rational_triangles(all.scene);
  const auto closed = sees(scene, eyes, points);
  const auto generic = sees(scene, eyes, points, {.edges = EdgeRule::generic});
  // The law: who sees is seen.
  EXPECT_EQ(closed, sees(scene, points, eyes));
  EXPECT_EQ(generic, sees(scene, points, eyes, {.edges = EdgeRule::generic}));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(test::text_of(eyes[i]) + " to " + test::text_of(points[i]));
    const auto eye = test::rational_point(eyes[i], triangles);
    const auto point = test::rational_point(points[i], triangles);
    EXPECT_EQ(closed[i], oracle::see_each_other(eye, point, triangles));
    EXPECT_EQ(generic[i], is_open(eye, point, triangles));
    EXPECT_LE(closed[i], generic[i]);
  }
}

class SightAdversaries : public ::testing::TestWithParam<test::Family> {};

TEST_P(SightAdversaries, SeeWhatTheySeeInRationalNumbers) {
  checks::for_each_adversary(
      60, [&](std::uint64_t seed) { expect_as_by_rationals(GetParam().draw(seed), seed); });
}

TEST_P(SightAdversaries, SeeTheSameWithAllVectorInstructions) {
  for (const std::int64_t target : checks::vector_targets()) {
    const checks::OnlyTarget only(target);
    checks::for_each_adversary(
        2, [&](std::uint64_t seed) { expect_as_by_rationals(GetParam().draw(1000 + seed), seed); });
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SightAdversaries, ::testing::ValuesIn(test::families()),
                         [](const auto& family) { return family.param.name; });

/// The square [0, 4]² at z = 4, whose diagonal runs from (0, 0) to (4, 4).
Scene square() {
  return checks::scene_of({{0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}}, {{0, 1, 2}, {0, 2, 3}});
}

bool sees_one(const Scene& scene, const SightPoint& eye, const SightPoint& point,
              EdgeRule edges = EdgeRule::closed) {
  return sees(RayScene(scene), std::array{eye}, std::array{point}, {.edges = edges}).front();
}

TEST(Sight, EndsAtTheWallOnPaper) {
  const Scene scene = square();
  const Point eye{1, 3, 0};
  EXPECT_FALSE(sees_one(scene, eye, Point{1, 3, 8}));
  EXPECT_TRUE(sees_one(scene, eye, Point{1, 3, 3}));
  // The point of the wall itself is seen from both sides; a point one ulp beyond it is not.
  EXPECT_TRUE(sees_one(scene, eye, Point{1, 3, 4}));
  EXPECT_TRUE(sees_one(scene, Point{1, 3, 9}, Point{1, 3, 4}));
  EXPECT_FALSE(sees_one(scene, eye, Point{1, 3, std::nextafter(4, 8)}));
  EXPECT_TRUE(sees_one(scene, eye, SurfacePoint{1, 0.25, 0.5}));
  EXPECT_TRUE(sees_one(scene, eye, eye));
}

TEST(Sight, IsHiddenByEdgesUnlessTheyAreGeneric) {
  const Scene scene = square();
  const auto through = [&](double x, double y, EdgeRule edges) {
    return sees_one(scene, Point{x, y, 0}, Point{x, y, 8}, edges);
  };
  for (const auto& [x, y] : {std::pair{4.0, 2.0}, std::pair{2.0, 4.0}, std::pair{4.0, 4.0}}) {
    EXPECT_FALSE(through(x, y, EdgeRule::closed));
    EXPECT_TRUE(through(x, y, EdgeRule::generic));
  }
  // The diagonal belongs to one of two triangles, the sides at x = 0 and y = 0 to the wall.
  EXPECT_FALSE(through(2, 2, EdgeRule::generic));
  EXPECT_FALSE(through(0, 2, EdgeRule::generic));
  EXPECT_TRUE(through(std::nextafter(4, 8), 2, EdgeRule::closed));
}

TEST(Sight, PassesAlongAWall) {
  EXPECT_TRUE(sees_one(square(), Point{-1, 2, 4}, Point{9, 2, 4}));
}

TEST(Sight, OfEachPairIsRowByRow) {
  const Scene scene = square();
  const RayScene prepared(scene);
  const std::vector<SightPoint> eyes{Point{1, 1, 0}, Point{9, 9, 0}};
  const std::vector<SightPoint> points{Point{1, 1, 9}, Point{2, 1, 1}, SurfacePoint{0, 0.5, 0.25}};
  EXPECT_EQ(sees_each(prepared, eyes, points),
            (std::vector<bool>{false, true, true, true, true, true}));
  EXPECT_TRUE(sees_each(prepared, {}, points).empty());
  EXPECT_TRUE(sees_each(prepared, eyes, {}).empty());
}

TEST(Sight, IsTheSameWithAnyNumberOfThreads) {
  const test::RayCase all = test::families()[1].draw(5);
  std::vector<SightPoint> eyes, points;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (const auto& [eye, point] : test::draw_pairs(all, seed)) {
      eyes.push_back(eye);
      points.push_back(point);
    }
  }
  const RayScene scene(all.scene);
  EXPECT_EQ(sees(scene, eyes, points, {.threads = 1}), sees(scene, eyes, points, {.threads = 7}));
}

TEST(Sight, IsOpenInAnEmptyScene) {
  const Scene scene;
  EXPECT_TRUE(sees_one(scene, Point{1e300, 0, 0}, Point{-1e300, 1e-300, 0}));
}

template <class Failure>
std::string message_for(const std::vector<SightPoint>& eyes,
                        const std::vector<SightPoint>& points) {
  const Scene scene = square();
  try {
    sees(RayScene(scene), eyes, points);
  } catch (const Failure& e) {
    return e.what();
  }
  return "";
}

TEST(Sight, NamesThePointThatIsNone) {
  const SightPoint fine = Point{0, 0, 0};
  EXPECT_EQ(message_for<InputError>({fine, Point{0, NAN, 0}}, {fine, fine}),
            "eye 1: its coordinates are not finite");
  EXPECT_EQ(message_for<InputError>({fine}, {SurfacePoint{2, 0, 0}}),
            "point 0: there is no triangle 2");
  EXPECT_EQ(message_for<InputError>({fine}, {SurfacePoint{1, 0, INFINITY}}),
            "point 0: its weights are not finite");
  EXPECT_EQ(message_for<UsageError>({fine}, {fine, fine}), "points: expected as many as eyes, 1");
}

}  // namespace
}  // namespace fathom::rays
