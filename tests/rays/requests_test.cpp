#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/ray_tree.h"
#include "tests/inputs/scene_building.h"
#include "tests/special_values.h"

namespace fathom::rays {
namespace {

/// The square [0, 4]² at z = 4, whose diagonal runs from (0, 0) to (4, 4).
Scene square() {
  return checks::scene_of({{0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}}, {{0, 1, 2}, {0, 2, 3}});
}

RayHit cast_one(const Scene& scene, const Ray& ray, const CastOptions& options = {}) {
  return cast(RayScene(scene), std::array{ray}, options).front();
}

std::string message_for(const std::vector<Ray>& rays, const CastOptions& options = {}) {
  const Scene scene = square();
  try {
    cast(RayScene(scene), rays, options);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Cast, FindsTheTriangleOnPaper) {
  EXPECT_EQ(cast_one(square(), {{3, 1, 0}, {0, 0, 2}}), (RayHit{0, 2}));
  EXPECT_EQ(cast_one(square(), {{1, 3, 0}, {0, 0, 2}}), (RayHit{1, 2}));
  EXPECT_EQ(cast_one(square(), {{1, 3, 0}, {0, 0, -2}}), RayHit{});
  EXPECT_EQ(cast_one(square(), {{5, 3, 0}, {0, 0, 2}}), RayHit{});
}

// The origin moves by ε along x first: towards triangle 0, and off the sides at x = 4 and y = 4.
TEST(Cast, GivesAPointOfAnEdgeToOneTriangle) {
  EXPECT_EQ(cast_one(square(), {{2, 2, 0}, {0, 0, 1}}), (RayHit{0, 4}));
  EXPECT_EQ(cast_one(square(), {{0, 2, 0}, {0, 0, 1}}), (RayHit{1, 4}));
  EXPECT_EQ(cast_one(square(), {{2, 0, 0}, {0, 0, 1}}), (RayHit{0, 4}));
  EXPECT_EQ(cast_one(square(), {{4, 2, 0}, {0, 0, 1}}), RayHit{});
  EXPECT_EQ(cast_one(square(), {{2, 4, 0}, {0, 0, 1}}), RayHit{});
  EXPECT_EQ(cast_one(square(), {{0, 0, 0}, {0, 0, 1}}), (RayHit{0, 4}));
}

TEST(Cast, CountsTheEndsOfASegmentUnlessItIsOpen) {
  const Ray ray{{3, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(cast_one(square(), ray, {.segment = {0, 4}}), (RayHit{0, 4}));
  EXPECT_EQ(cast_one(square(), ray, {.segment = {4, 9}}), (RayHit{0, 4}));
  EXPECT_EQ(cast_one(square(), ray, {.segment = {0, 4, true}}), RayHit{});
  EXPECT_EQ(cast_one(square(), ray, {.segment = {4, 9, true}}), RayHit{});
  EXPECT_EQ(cast_one(square(), ray, {.segment = {0, std::nextafter(4, 0)}}), RayHit{});
  const Ray back{{3, 1, 8}, {0, 0, 1}};
  EXPECT_EQ(cast_one(square(), back), RayHit{});
  EXPECT_EQ(cast_one(square(), back, {.segment = {-infinity, 0}}), (RayHit{0, -4}));
}

TEST(Cast, CullsByTheSideThatARayMeets) {
  const Ray up{{3, 1, 0}, {0, 0, 1}}, down{{3, 1, 9}, {0, 0, -1}};
  EXPECT_EQ(cast_one(square(), up, {.cull = Cull::front}), (RayHit{0, 4}));
  EXPECT_EQ(cast_one(square(), up, {.cull = Cull::back}), RayHit{});
  EXPECT_EQ(cast_one(square(), down, {.cull = Cull::back}), (RayHit{0, 5}));
  EXPECT_EQ(cast_one(square(), down, {.cull = Cull::front}), RayHit{});
}

TEST(Cast, PrefersTheLowerNumberOfEqualTriangles) {
  Scene scene = square();
  scene.objects.push_back(scene.objects[0]);
  EXPECT_EQ(cast_one(scene, {{1, 3, 0}, {0, 0, 1}}), (RayHit{1, 4}));
  const auto all = all_hits(RayScene(scene), std::array{Ray{{1, 3, 0}, {0, 0, 1}}});
  EXPECT_EQ(all.hits, (std::vector<RayHit>{{1, 4}, {3, 4}}));
}

/// A triangle at z = 4 that faces down, `copies` times, and after each copy one at z = 5.
Scene crowd(std::uint32_t copies) {
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < copies; ++i) {
    triangles.push_back({0, 2, 1});
    triangles.push_back({3, 5, 4});
  }
  return checks::scene_of({{0, 0, 4}, {4, 0, 4}, {0, 4, 4}, {0, 0, 5}, {4, 0, 5}, {0, 4, 5}},
                          std::move(triangles));
}

TEST(Cast, CountsEachTriangleOfACrowd) {
  constexpr std::uint32_t copies = 3000;
  const Scene scene = crowd(copies);
  const RayScene prepared(scene);
  EXPECT_EQ(prepared.tree().repetition_count(), 2 * (copies - 1));
  // Through the inside, and through the corner that belongs to the triangles.
  for (const Ray& ray : {Ray{{1, 1, 0}, {0, 0, 1}}, Ray{{0, 0, 0}, {0, 0, 1}}}) {
    const std::array rays{ray};
    EXPECT_EQ(cast(prepared, rays).front(), (RayHit{0, 4}));
    EXPECT_EQ(cast(prepared, rays, {.segment = {4.5}}).front(), (RayHit{1, 5}));
    EXPECT_TRUE(occluded(prepared, rays).front());
    EXPECT_EQ(count_hits(prepared, rays).front(), 2 * copies);
    const RayHitLists all = all_hits(prepared, rays);
    ASSERT_EQ(all.hits.size(), 2 * copies);
    for (std::uint32_t i = 0; i < copies; ++i) {
      EXPECT_EQ(all.hits[i], (RayHit{2 * i, 4}));
      EXPECT_EQ(all.hits[copies + i], (RayHit{2 * i + 1, 5}));
    }
  }
}

TEST(Cast, CountsCrowdsInWindingNumbers) {
  // Around the origin, ten times.
  std::vector<CornerIndices> triangles;
  for (int i = 0; i < 10; ++i)
    triangles.insert(triangles.end(), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  const Scene scene =
      checks::scene_of({{-1, -1, -1}, {3, -1, -1}, {-1, 3, -1}, {-1, -1, 3}}, triangles);
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {9, 0, 0}, {-9, 0, 0}};
  EXPECT_EQ(winding_numbers(RayScene(scene), points), (std::vector<std::int64_t>{10, 0, 0}));
}

/// The first object once more, moved by 2⁻⁶⁰ along z: too little for binary64.
Scene nearly_equal_objects() {
  Scene scene = checks::scene_of({{0, 0, 4}, {4, 0, 4}, {0, 4, 4}}, {{0, 1, 2}});
  for (int i = 0; i < 6; ++i) {
    Object moved = scene.objects[0];
    moved.world_from_mesh.rows[2][3] = -std::ldexp(1.0, -60);
    moved.placed_as_is = false;
    scene.objects.push_back(moved);
  }
  return scene;
}

TEST(Cast, DistinguishesTrianglesThatAreEqualInBinary64) {
  const Scene scene = nearly_equal_objects();
  const RayScene prepared(scene);
  EXPECT_EQ(cast(prepared, std::array{Ray{{1, 1, 0}, {0, 0, 1}}}).front(), (RayHit{1, 4}));
  const auto all = all_hits(prepared, std::array{Ray{{1, 1, 0}, {0, 0, 1}}}).hits;
  EXPECT_EQ(all, (std::vector<RayHit>{{1, 4}, {2, 4}, {3, 4}, {4, 4}, {5, 4}, {6, 4}, {0, 4}}));
}

TEST(RayTree, HasExactCornersByObject) {
  const Scene scene = nearly_equal_objects();
  const RayScene prepared(scene);
  EXPECT_TRUE(prepared.tree().has_exact_corners(0));
  EXPECT_FALSE(prepared.tree().has_exact_corners(1));
}

TEST(RayTree, IgnoresAVertexWithoutATriangle) {
  Scene scene = square();
  const long power = RayScene(scene).tree().power();
  auto vertices =
      std::vector<MeshPoint>(scene.meshes[0].vertices.begin(), scene.meshes[0].vertices.end());
  vertices.push_back({1e300, 0, 0});
  scene.meshes[0].vertices = std::move(vertices);
  const RayScene prepared(scene);
  EXPECT_EQ(prepared.tree().power(), power);
  EXPECT_EQ(cast(prepared, std::array{Ray{{1, 3, 0}, {0, 0, 1}}}).front(), (RayHit{1, 4}));
}

TEST(Cast, MeetsNothingInAnEmptyScene) {
  const std::array rays{Ray{{0, 0, 0}, {0, 0, 1}}, Ray{{1e300, 0, 0}, {0, 0, 1}}};
  for (const Scene& scene : {Scene{}, checks::scene_of({{1, 1, 1}}, {{0, 0, 0}})}) {
    const RayScene prepared(scene);
    EXPECT_EQ(cast(prepared, rays), (std::vector<RayHit>{{}, {}}));
    EXPECT_EQ(all_hits(prepared, rays).splits, (std::vector<std::size_t>{0, 0, 0}));
    EXPECT_EQ(contains(prepared, std::vector<std::array<double, 3>>{{0, 0, 0}}),
              (std::vector<bool>{false}));
  }
  EXPECT_TRUE(cast(RayScene(square()), {}).empty());
}

TEST(Cast, NamesTheRayThatIsNone) {
  const Ray fine{{0, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(message_for({fine, {{0, 0, 0}, {0, -0.0, 0}}}), "ray 1: its direction is 0");
  EXPECT_EQ(message_for({fine, fine, {{0, NAN, 0}, {0, 1, 0}}}), "ray 2: its origin is not finite");
  EXPECT_EQ(message_for({{{0, 0, 0}, {0, 1, infinity}}}), "ray 0: its direction is not finite");
  EXPECT_THROW(contains(RayScene(square()), std::vector<std::array<double, 3>>{{0, infinity, 0}}),
               InputError);
}

TEST(Cast, RefusesASegmentThatEndsBeforeItBegins) {
  const Ray fine{{0, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(message_for({fine}, {.segment = {2, 1}}),
            "t_min: expected a number that is at most t_max");
  EXPECT_NE(message_for({fine}, {.segment = {NAN, 1}}), "");
  EXPECT_NE(message_for({}, {.segment = {0, NAN}}), "");
  EXPECT_NE(message_for({fine}, {.threads = -1}), "");
}

TEST(RayScene, RefusesASceneWithAFault) {
  const Scene scene = checks::scene_of({{0, 0, NAN}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_THROW(RayScene prepared(scene), InputError);
}

}  // namespace
}  // namespace fathom::rays
