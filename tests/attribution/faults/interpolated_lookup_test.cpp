// Maps of a pinhole that are looked up bilinearly for a camera with a lens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/camera_directions.h"
#include "fathom/render.h"
#include "validation/scenes/shapes.h"

namespace fathom::attribution::interpolated_lookup {
namespace {

using testing::HasSubstr;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr int width = 64, height = 48;
constexpr double focal_length = 40;

/// A tilted wall, which leaves some background, and a sphere.
Scene shapes() {
  Mesh wall;
  wall.vertices = {{-3, -7, 5}, {9, -7, 6.5}, {9, 7, 7.25}, {-3, 7, 5.75}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.face_count = 2;
  return bench::as_scene({std::move(wall), bench::sphere(500, {0.4, -0.3, 3.5}, 1.2)}, "shapes");
}

/// `room`: pixels around the image of the lens's camera.
Camera pinhole(int room) {
  Camera camera;
  camera.width = width + 2 * room;
  camera.height = height + 2 * room;
  camera.projection = {
      .fx = focal_length, .fy = focal_length, .cx = width / 2. + room, .cy = height / 2. + room};
  return camera;
}

Camera bent_camera() {
  Camera camera = pinhole(0);
  camera.projection.lens = Lens{LensModel::opencv, {-0.2, 0.04, 0.006, -0.004}};
  return camera;
}

/// How a program looks up.
struct Program {
  int room = 0;
  /// Added to the place.
  double offset = 0;
  bool in_32nds = false;
  float background = infinity;
};

/// Sums of products in binary32, as programs have them.
OtherMap looked_up(const Program& program) {
  const DepthMap map = render(shapes(), pinhole(program.room), {.channels = {Channel::Z}}).map;
  std::vector<float> depths;
  for (const float depth : *map.values<float>("Z"))
    depths.push_back(std::isfinite(depth) ? depth : program.background);
  const int columns = width + 2 * program.room, rows = height + 2 * program.room;
  const auto depth_at = [&](int column, int row) {
    const bool is_inside = column >= 0 && row >= 0 && column < columns && row < rows;
    return is_inside ? depths[static_cast<std::size_t>(row * columns + column)]
                     : program.background;
  };
  const DirectionTable rays = directions_of(bent_camera());
  std::vector<float> values;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto ray =
          *rays.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
      const auto place_of = [&](double slope, int size) {
        const double place = focal_length * slope + size / 2. + program.room - 0.5 + program.offset;
        return program.in_32nds ? std::nearbyint(place * 32) / 32 : place;
      };
      const double x = place_of(ray[0] / ray[2], width), y = place_of(ray[1] / ray[2], height);
      const int left = static_cast<int>(std::floor(x)), above = static_cast<int>(std::floor(y));
      const auto right = static_cast<float>(x - left), below = static_cast<float>(y - above);
      const float value = depth_at(left, above) * ((1 - right) * (1 - below)) +
                          depth_at(left + 1, above) * (right * (1 - below)) +
                          depth_at(left, above + 1) * ((1 - right) * below) +
                          depth_at(left + 1, above + 1) * (right * below);
      values.push_back(std::isnan(value) ? infinity : value);
    }
  }
  DepthMap result{.width = width, .height = height};
  result.channels = {{"Z", std::move(values)}};
  return other_map(result);
}

Attribution judged(const OtherMap& map) {
  return judge_map("map", map, shapes(), bent_camera(), std::nullopt).attribution;
}

std::uint64_t pixels_named(const Attribution& found, const std::string& text) {
  EXPECT_EQ(found.findings.size(), 1U);
  if (found.findings.empty()) return 0;
  EXPECT_EQ(found.findings.front().kind, "remapped");
  EXPECT_THAT(found.findings.front().text, HasSubstr(text));
  return found.findings.front().pixels;
}

TEST(InterpolatedLookup, MeansAreNamedWhateverTheWeightsAndTheSizeOfTheImage) {
  for (const Program& program : {Program{}, Program{.in_32nds = true}, Program{.room = 40},
                                 Program{.room = 40, .in_32nds = true}}) {
    const Attribution found = judged(looked_up(program));
    EXPECT_GT(pixels_named(found, "was looked up bilinearly:"), 200U);
    EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  }
}

TEST(InterpolatedLookup, HalfAPixelIsNamedToo) {
  for (const double offset : {-0.5, 0.5}) {
    const Attribution found = judged(looked_up({.room = 40, .offset = offset}));
    EXPECT_GT(pixels_named(found, offset > 0 ? "bilinearly, +0.5 pixels off"
                                             : "bilinearly, -0.5 pixels off"),
              1000U);
    EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  }
}

TEST(InterpolatedLookup, MeansWithTheValueOfTheBackgroundAreExplained) {
  const Attribution found = judged(looked_up({.room = 40, .background = 0}));
  EXPECT_GT(pixels_named(found, "was looked up bilinearly:"), 200U);
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
}

TEST(InterpolatedLookup, ValuesThatAreNoMeansRemainUnexplained) {
  OtherMap map = looked_up({.room = 40});
  const std::size_t middle = std::size_t{height / 2} * width + width / 2;
  map.depths[middle] *= 1.001;
  map.values[middle] = map.depths[middle];
  const Attribution found = judged(map);
  EXPECT_EQ(found.count(PixelClass::unexplained), 1U);
  EXPECT_EQ(found.classes[middle], PixelClass::unexplained);
}

/// The depths of neighbours in the bent image are mixed, which is another fault.
TEST(InterpolatedLookup, AFilteredMapIsNotTakenForOne) {
  OtherMap map = other_map(render(shapes(), bent_camera(), {.channels = {Channel::Z}}).map);
  const std::vector<double> sharp = map.depths;
  for (std::size_t i = 1; i < sharp.size(); ++i) map.depths[i] = (sharp[i - 1] + sharp[i]) / 2;
  map.values = map.depths;
  for (const Finding& finding : judged(map).findings) EXPECT_NE(finding.kind, "remapped");
}

}  // namespace
}  // namespace fathom::attribution::interpolated_lookup
