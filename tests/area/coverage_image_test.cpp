// Bands of rows hold every triangle that meets them; the image is what its pixels are one by one.
#include "fathom/area/coverage_image.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <vector>

#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace area;
using checks::CaseMaker;
using checks::Kind;

std::vector<std::uint32_t> all_triangles(const CoverageFrame& frame) {
  std::vector<std::uint32_t> numbers(frame.triangles.count());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// Every triangle alone is looked for in each pixel that it covers a part of.
TEST(TriangleBands, HoldEveryTriangleThatMeetsThem) {
  std::mt19937_64 random(171);
  const Scene scene = checks::soup(random, 24, false);
  const Camera camera = checks::camera_of(160, 37, 64);
  const CoverageFrame frame{scene, camera};
  const TriangleBands bands(frame);
  ASSERT_EQ(bands.count(), 5U);
  EXPECT_EQ(bands[4].first_row, 32U);
  EXPECT_EQ(bands[4].end_row, 37U);
  int met = 0;
  for (std::uint32_t k = 0; k < bands.count(); ++k) {
    const auto triangles = bands[k].triangles;
    EXPECT_TRUE(std::is_sorted(
        triangles.begin(), triangles.end(),
        [](const BoxedTriangle& a, const BoxedTriangle& b) { return a.number < b.number; }));
    for (std::uint32_t row = bands[k].first_row; row < bands[k].end_row; row += checks::effort) {
      for (std::uint32_t column = 0; column < camera.width; column += 3) {
        for (const std::uint32_t number : all_triangles(frame)) {
          if (pixel_coverage(frame, {{number}}, column, row).sign() == Sign::zero) continue;
          ++met;
          const auto found =
              std::find_if(triangles.begin(), triangles.end(),
                           [&](const BoxedTriangle& t) { return t.number == number; });
          ASSERT_NE(found, triangles.end()) << number << " at " << column << ' ' << row;
          ASSERT_TRUE(found->box.contains(column, row));
        }
      }
    }
  }
  EXPECT_GT(met, 100);
}

TEST(CoverageImage, IsWhatItsPixelsAre) {
  CaseMaker maker(172, Kind::neighbours);
  for (int i = 0; i < 60 / checks::effort + 1; ++i) {
    const checks::Case c = maker.make();
    const CoverageFrame frame{c.scene, c.camera, i % 3 == 0 ? Cull::back : Cull::none};
    const std::uint32_t width = c.camera.width, height = c.camera.height;
    std::vector<float> values(std::size_t{width} * height);
    std::atomic<std::uint32_t> parts = 0;
    write_coverage(frame, values.data(), [&] { ++parts; });
    EXPECT_EQ(parts, TriangleBands(frame).count());
    const std::vector<std::uint32_t> all = all_triangles(frame);
    for (std::uint32_t row = 0; row < height; ++row) {
      for (std::uint32_t column = 0; column < width; ++column) {
        ASSERT_EQ(values[row * width + column], rounded_pixel_coverage(frame, all, column, row));
      }
    }
  }
}

TEST(CoverageImage, EachPixelIsVisitedOnceWithItsTrianglesInOrder) {
  std::mt19937_64 random(173);
  const Scene scene = checks::soup(random, 30, true);
  const Camera camera = checks::camera_of(60, 50, 24);
  const CoverageFrame frame{scene, camera};
  std::vector<std::atomic<int>> visits(60 * 50);
  for_each_pixel(frame, [&](std::uint32_t column, std::uint32_t row, auto triangles) {
    ++visits[row * 60 + column];
    EXPECT_FALSE(triangles.empty());
    EXPECT_TRUE(std::is_sorted(
        triangles.begin(), triangles.end(),
        [](const SurfaceRegion* a, const SurfaceRegion* b) { return a->number < b->number; }));
  });
  for (const auto& count : visits) EXPECT_LE(count, 1);
}

}  // namespace
}  // namespace fathom
