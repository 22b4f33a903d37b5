// Visible fragments and mattes of a picture of two pixels, known on paper.
#include "fathom/area/deep_pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "fathom/area/visible_areas.h"
#include "tests/area/surfaces.h"

namespace fathom {
namespace {

using namespace area;
using checks::plain_camera;
using checks::scene_of;

/// Pixel (0, 0): triangle 0 at depth 2 covers its lower left half; behind it, at depth 3 + v, lies
/// triangle 1, which covers the left three quarters of pixel (1, 0) too, and all of (0, 0).
Scene two_layers() {
  return scene_of({{0, 0, 2},
                   {0, 1, 2},
                   {1, 1, 2},  //
                   {-9, -9, -6},
                   {1.75, -9, -6},
                   {1.75, 99, 102},
                   {-9, 99, 102}},
                  {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}});
}

TEST(DeepPixels, FragmentsAreSortedAndAddUp) {
  const Scene scene = two_layers();
  const DeepMap map = visible_in_pixels(scene, plain_camera(2, 1), {});
  ASSERT_EQ(map.counts.size(), 2U);
  // Triangles 1 and 2 share a diagonal, from (−9, −9) to (1.75, 99), which passes left of and above
  // both pixels: all of them is triangle 1's.
  ASSERT_EQ(map.counts[0], 2U);
  ASSERT_EQ(map.counts[1], 1U);
  const DeepSample &near = map.samples[0], &far = map.samples[1], &beside = map.samples[2];
  EXPECT_EQ(near.id, 0U);
  EXPECT_EQ(near.Z, 2);
  EXPECT_EQ(near.ZBack, 2);
  EXPECT_EQ(near.area, 0.5F);
  EXPECT_EQ(near.A, 0.5F);
  EXPECT_EQ(far.id, 1U);
  EXPECT_EQ(far.Z, 3);
  EXPECT_EQ(far.ZBack, 4);  // its visible half reaches from (0, 0) to (1, 1)
  EXPECT_EQ(far.area, 0.5F);
  EXPECT_EQ(far.A, 1);  // of what is left, all
  EXPECT_EQ(beside.id, 1U);
  EXPECT_EQ(beside.area, 0.75F);
  EXPECT_EQ(beside.A, 0.75F);
  EXPECT_EQ(beside.Z, 3);
  EXPECT_EQ(beside.ZBack, 4);
}

TEST(DeepPixels, MattesAddUpTheirTriangles) {
  const Scene scene = two_layers();
  const auto shares = [&](const std::function<std::uint32_t(std::uint32_t)>& matte_of) {
    std::vector<std::pair<std::uint32_t, float>> found;
    for (const MatteShare& share :
         mattes_in_pixels(scene, plain_camera(2, 1), {}, matte_of).shares) {
      found.emplace_back(share.id, share.coverage);
    }
    return found;
  };
  using Found = std::vector<std::pair<std::uint32_t, float>>;
  // Equal coverages by id.
  EXPECT_EQ(shares([](std::uint32_t t) { return 100 - t; }),
            (Found{{99, 0.5F}, {100, 0.5F}, {99, 0.75F}}));
  EXPECT_EQ(shares([](std::uint32_t) { return 7; }), (Found{{7, 1}, {7, 0.75F}}));
}

/// Triangles one behind the other, each of which hides a part of those behind it.
Scene many_layers(std::uint32_t count) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> place(-0.1, 1.1), size(0.02, 0.2);
  std::vector<MeshPoint> points;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double depth = 2 + i * 0x1p-8, u = place(random), v = place(random);
    for (int k = 0; k < 3; ++k) points.push_back({u + size(random), v + size(random), depth});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return scene_of(points, triangles);
}

// The areas of a picture of one pixel are those of the scene, whose sums are known to binary64.
TEST(DeepPixels, HundredsOfFragmentsAddUp) {
  const Scene scene = many_layers(700);
  const Camera camera = plain_camera(1, 1);
  const DeepMap map = visible_in_pixels(scene, camera, {});
  const VisibleAreas areas = visible_areas(scene, camera, {});
  ASSERT_GT(map.samples.size(), 300U);
  double left = 1;
  for (const DeepSample& sample : map.samples) {
    const double area = areas.triangles[sample.id].visible;
    EXPECT_EQ(sample.area, static_cast<float>(area));
    EXPECT_FLOAT_EQ(sample.A, static_cast<float>(area / left));
    left -= area;
  }
  const Mattes mattes = mattes_in_pixels(scene, camera, {}, [](std::uint32_t) { return 7U; });
  ASSERT_EQ(mattes.shares.size(), 1U);
  EXPECT_FLOAT_EQ(mattes.shares[0].coverage, static_cast<float>(1 - left));
}

TEST(DeepPixels, CullingLeavesTrianglesOut) {
  const Scene scene = two_layers();
  RenderOptions options;
  std::size_t both = 0;
  for (const Cull cull : {Cull::back, Cull::front}) {
    options.cull = cull;
    both += visible_in_pixels(scene, plain_camera(2, 1), options).samples.size();
  }
  EXPECT_EQ(both, 3U);  // the layers run round in different ways
}

}  // namespace
}  // namespace fathom
