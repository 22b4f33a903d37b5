// What is certain of triangles for channel A: side and box, on paper and against exact areas.
#include "fathom/fast/coverage/tile_coverage.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

std::vector<CoverageTriangle> classes_of(const Scene& scene, const Camera& camera,
                                         const PixelBox& tile) {
  const ImageObject object(scene.objects[0], scene.meshes[0], camera, 0);
  std::vector<std::uint32_t> numbers(scene.meshes[0].triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::vector<CoverageTriangle> classes(numbers.size());
  classify_for_coverage(object, numbers, depth_range(camera), tile, classes.data());
  return classes;
}

TEST(CoverageClasses, OnPaper) {
  Camera camera = checks::camera_of(100, 100, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  camera.near = 1;
  camera.far = 9;
  const Scene scene = checks::scene_of({{2.25, 3.25, 2},
                                        {4.75, 3.25, 2},
                                        {2.25, 6.5, 2},  // in the range
                                        {2, 3, 12},
                                        {4, 3, 12},
                                        {2, 6, 12},  // all behind far
                                        {2, 3, 0.5},
                                        {4, 3, 2},
                                        {2, 6, 2}},  // cut at near
                                       {{0, 1, 2}, {0, 2, 1}, {3, 4, 5}, {6, 7, 8}});
  const auto classes = classes_of(scene, camera, {0, 63, 0, 63});
  EXPECT_EQ(classes[0].kind, CoverageClass::positive);
  EXPECT_EQ(classes[1].kind, CoverageClass::negative);
  EXPECT_EQ(classes[2].kind, CoverageClass::nothing);
  EXPECT_EQ(classes[3].kind, CoverageClass::open);
  for (const std::size_t i : {0U, 1U}) {
    const TileBox& box = classes[i].box;
    EXPECT_FALSE(box.is_empty());
    EXPECT_LE(box.left, 2);
    EXPECT_GE(box.right, 4);
    EXPECT_LE(box.top, 3);
    EXPECT_GE(box.bottom, 6);
    EXPECT_GE(box.left, 1);
    EXPECT_LE(box.right, 5);
  }
}

/// Where a class is certain, the pixels in which the triangle has an area lie in its box.
TEST(CoverageClasses, BoxesHoldEveryPixelWithAnArea) {
  std::mt19937_64 random(221);
  int inside = 0, certain = 0;
  for (int i = 0; i < 4; ++i) {
    const Scene scene = checks::soup(random, 16, i % 2 == 0);
    Camera camera = checks::camera_of(160, 140, 64);
    if (i == 2) camera.near = 4;
    const PixelBox tile{64, 127, 0, 63};
    const auto classes = classes_of(scene, camera, tile);
    const CoverageFrame frame{scene, camera};
    for (std::uint32_t number = 0; number < classes.size(); ++number) {
      if (classes[number].kind == CoverageClass::open) continue;
      ++certain;
      const TileBox& box = classes[number].box;
      for (std::uint32_t row = 0; row < 64; row += 3) {
        for (std::uint32_t column = 0; column < 64; column += 3) {
          if (pixel_coverage(frame, {{number}}, 64 + column, row).sign() == Sign::zero) continue;
          ++inside;
          ASSERT_NE(classes[number].kind, CoverageClass::nothing);
          ASSERT_TRUE(static_cast<std::uint32_t>(box.left) <= column &&
                      column <= static_cast<std::uint32_t>(box.right) &&
                      static_cast<std::uint32_t>(box.top) <= row &&
                      row <= static_cast<std::uint32_t>(box.bottom));
        }
      }
    }
  }
  EXPECT_GT(certain, 30);
  EXPECT_GT(inside, 200);
}

}  // namespace
}  // namespace fathom
