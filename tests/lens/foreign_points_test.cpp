// Every row of the table of models against the code of the program that it comes from: COLMAP and
// Nerfstudio take rays to images, and the samples there see these rays. OpenCV: stage_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "fathom/camera/camera_files.h"
#include "fathom/lens/preimages.h"
#include "tests/places.h"

namespace fathom::lens {
namespace {

/// A line of points_of_….txt.
struct ForeignPoint {
  std::string model;
  /// All parameters, in the order of the other program.
  std::vector<double> params;
  std::array<double, 3> ray;
  /// Whole numbers lie at corners of pixels.
  std::array<double, 2> image;
};

std::vector<ForeignPoint> points_of(const std::string& program) {
  std::ifstream file(test::source_dir() / ("tests/lens/points_of_" + program + ".txt"));
  std::vector<ForeignPoint> points;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    ForeignPoint& point = points.emplace_back();
    words >> point.model;
    for (std::string word; words >> word;)
      point.params.push_back(std::strtod(word.c_str(), nullptr));
    const auto end = point.params.end();
    std::copy(end - 5, end - 2, point.ray.begin());
    std::copy(end - 2, end, point.image.begin());
    point.params.erase(end - 5, end);
  }
  return points;
}

/// The camera that a user gets from these parameters.
Camera camera_of(const ForeignPoint& point) {
  std::string params;
  for (const double number : point.params)
    params += fmt::format("{}{}", params.empty() ? "" : ", ", number);
  return read_cameras(
             fmt::format(R"({{"width": 640, "height": 480, "pixel_centre": 0.5, "model": "{}",
                              "params": [{}], "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0],
                              [0, 0, 1, 0]]}})",
                         point.model, params),
             "camera.json")
      .at(0);
}

double middle(const DyadicInterval& interval) {
  const Interval ends = enclose(interval.low + interval.high);
  return (ends.lower + ends.upper) / 4;
}

/// How far the ray that an image sees is from the point's own on the plane z = 1, in pixels.
double pixels_between(const ForeignPoint& point) {
  const Projection projection = camera_of(point).projection;
  const Preimages preimages(projection, *projection.lens);
  const auto direction = preimages.of(point.image[0], point.image[1]);
  if (!direction) return HUGE_VAL;
  const auto [x, y, z] = direction->enclosure(100);
  const double dx = middle(x) / middle(z) - point.ray[0] / point.ray[2];
  const double dy = middle(y) / middle(z) - point.ray[1] / point.ray[2];
  return std::hypot(projection.fx * dx, projection.fy * dy);
}

TEST(ForeignPoints, AreSeenWhereColmapShowsThem) {
  std::multiset<std::string> models;
  for (const ForeignPoint& point : points_of("colmap")) {
    models.insert(point.model);
    EXPECT_LE(pixels_between(point), 1e-12) << point.model;
  }
  for (const char* const model :
       {"SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV", "FULL_OPENCV", "FOV",
        "SIMPLE_DIVISION", "DIVISION", "SIMPLE_FISHEYE", "FISHEYE", "SIMPLE_RADIAL_FISHEYE",
        "RADIAL_FISHEYE", "OPENCV_FISHEYE", "THIN_PRISM_FISHEYE", "RAD_TAN_THIN_PRISM_FISHEYE"})
    EXPECT_EQ(models.count(model), 12U) << model;
}

TEST(ForeignPoints, AreSeenWhereNerfstudioShowsThem) {
  const std::vector<ForeignPoint> points = points_of("nerfstudio");
  EXPECT_EQ(points.size(), 12U);
  for (const ForeignPoint& point : points) {
    EXPECT_EQ(point.model, "BROWN");
    EXPECT_LE(pixels_between(point), 1e-12);
  }
}

// The stereographic projection by its definition: at twice the tangent of half the angle.
TEST(ForeignPoints, AreSeenWhereTheStereographicProjectionShowsThem) {
  for (int i = 1; i < 8; ++i) {
    const double angle = std::numbers::pi / 16 * i, turn = 0.7 * i;
    const double radius = 2 * std::tan(angle / 2);
    const std::array ray{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                         std::cos(angle)};
    const ForeignPoint point{
        "FISHEYE_STEREOGRAPHIC",
        {100, 101, 3, -2},
        ray,
        {100 * radius * std::cos(turn) + 3, 101 * radius * std::sin(turn) - 2}};
    // The plane z = 1 is far away at the horizon.
    EXPECT_LE(pixels_between(point) * std::cos(angle) * std::cos(angle), 1e-12) << i;
  }
}

}  // namespace
}  // namespace fathom::lens
