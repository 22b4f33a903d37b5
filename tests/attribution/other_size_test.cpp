#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "fathom/attribution/other_scene.h"

namespace fathom::attribution {
namespace {

Camera camera_of(std::uint32_t width, std::uint32_t height) {
  Camera camera{.width = width, .height = height};
  camera.projection.fx = 100;
  camera.projection.fy = 90;
  camera.projection.cx = 31;
  camera.projection.cy = 22;
  camera.projection.skew = 4;
  camera.projection.pixel_centre = 0;
  return camera;
}

/// Numbered pixel by pixel.
OtherMap map_of(std::uint32_t width, std::uint32_t height) {
  OtherMap map{.width = width, .height = height};
  for (std::uint32_t i = 0; i < width * height; ++i) map.depths.push_back(i);
  map.triangles.assign(map.depths.begin(), map.depths.end());
  return map;
}

/// Where a camera point is seen, in pixels from the image's top left corner.
std::array<double, 2> seen(const Camera& c, double x, double y, double z) {
  const double half = 0.5 - c.projection.pixel_centre;
  return {(c.projection.fx * x + c.projection.skew * y) / z + c.projection.cx + half,
          c.projection.fy * y / z + c.projection.cy + half};
}

const SizedMap* with_text(const std::vector<SizedMap>& readings, const std::string& text) {
  const auto found = std::find_if(readings.begin(), readings.end(), [&](const SizedMap& m) {
    return m.finding.text.find(text) != std::string::npos;
  });
  return found == readings.end() ? nullptr : &*found;
}

TEST(OtherSize, TheSameHasNoReading) {
  EXPECT_TRUE(readings_of_other_size(camera_of(64, 48), map_of(64, 48)).empty());
}

TEST(OtherSize, RowsAndColumnsExchanged) {
  const Camera camera = camera_of(64, 48);
  const auto readings = readings_of_other_size(camera, map_of(48, 64));
  ASSERT_FALSE(readings.empty());
  const SizedMap& first = readings.front();
  EXPECT_EQ(first.finding.kind, "axes");
  EXPECT_EQ(first.finding.text,
            "the map has 48x64 pixels, the camera 64x48: its rows and columns are exchanged");
  EXPECT_EQ(first.camera.width, 64U);
  EXPECT_EQ(first.camera.projection.cx, camera.projection.cx);
  ASSERT_EQ(first.map.width, 64U);
  ASSERT_EQ(first.map.height, 48U);
  for (std::uint32_t row = 0; row < 48; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      ASSERT_EQ(first.map.depths[row * 64 + column], column * 48 + row);
      ASSERT_EQ(first.map.triangles[row * 64 + column], column * 48 + row);
    }
  }
  EXPECT_TRUE(first.map.windows.empty());
}

struct Crop {
  const char* text;
  double left, above;  ///< pixels that are not in the map
};

// Three columns less and two rows more.
TEST(OtherSize, BordersMissingAndAdded) {
  const Camera camera = camera_of(64, 48);
  const auto readings = readings_of_other_size(camera, map_of(61, 50));
  ASSERT_EQ(readings.size(), 5U);
  for (const Crop& crop :
       {Crop{"3 columns missing at the right, 2 rows too many at the bottom", 0, 0},
        {"3 columns missing at the left, 2 rows too many at the bottom", 3, 0},
        {"3 columns missing at the right, 2 rows too many at the top", 0, -2},
        {"3 columns missing at the left, 2 rows too many at the top", 3, -2}}) {
    const SizedMap* const reading = with_text(readings, crop.text);
    ASSERT_NE(reading, nullptr) << crop.text;
    EXPECT_EQ(reading->finding.kind, "size");
    EXPECT_EQ(reading->camera.width, 61U);
    EXPECT_EQ(reading->camera.height, 50U);
    const auto [u, v] = seen(camera, 0.3, -0.2, 2);
    const auto [part_u, part_v] = seen(reading->camera, 0.3, -0.2, 2);
    EXPECT_DOUBLE_EQ(part_u, u - crop.left);
    EXPECT_DOUBLE_EQ(part_v, v - crop.above);
    EXPECT_EQ(reading->map.depths, map_of(61, 50).depths);
  }
}

TEST(OtherSize, OneRow) {
  const auto readings = readings_of_other_size(camera_of(64, 48), map_of(64, 47));
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_EQ(readings[0].finding.text,
            "the map has 64x47 pixels, the camera 64x48: 1 row missing at the bottom");
  EXPECT_THAT(readings[1].finding.text, testing::HasSubstr("1 row missing at the top"));
}

TEST(OtherSize, EightAreABorderAndNineAreNot) {
  EXPECT_EQ(readings_of_other_size(camera_of(64, 48), map_of(56, 48)).size(), 3U);
  EXPECT_EQ(readings_of_other_size(camera_of(64, 48), map_of(55, 48)).size(), 1U);
}

TEST(OtherSize, TheWholeViewDrawnInIt) {
  const Camera camera = camera_of(64, 48);
  const auto readings = readings_of_other_size(camera, map_of(128, 24));
  ASSERT_EQ(readings.size(), 1U);
  const Camera& scaled = readings[0].camera;
  EXPECT_EQ(readings[0].finding.kind, "size");
  EXPECT_EQ(scaled.width, 128U);
  EXPECT_EQ(scaled.height, 24U);
  for (const double x : {-0.4, 0.1, 0.5}) {
    const auto [u, v] = seen(camera, x, 0.3 - x, 2);
    const auto [scaled_u, scaled_v] = seen(scaled, x, 0.3 - x, 2);
    EXPECT_DOUBLE_EQ(scaled_u, 2 * u);
    EXPECT_DOUBLE_EQ(scaled_v, v / 2);
  }
}

}  // namespace
}  // namespace fathom::attribution
