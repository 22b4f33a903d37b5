// Maps through a lens whose numbers are right and used wrongly. Each map is drawn with the rays of
// the faulty program, which are computed here a second time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/render.h"
#include "validation/scenes/shapes.h"

namespace fathom::attribution::lens_conventions {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t width = 64, height = 48;
constexpr double focal_length = 40;

struct Point {
  double x, y;
};

/// A tilted wall and a sphere.
Scene shapes() {
  Mesh wall;
  wall.vertices = {{-9, -7, 5}, {9, -7, 6.5}, {9, 7, 7.25}, {-9, 7, 5.75}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.face_count = 2;
  return bench::as_scene({std::move(wall), bench::sphere(500, {0.4, -0.3, 3.5}, 1.2)}, "shapes");
}

Camera camera_with(const Lens& lens) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection = {
      .fx = focal_length, .fy = focal_length, .cx = width / 2., .cy = height / 2., .lens = lens};
  return camera;
}

/// The lens of the tests: k1, k2, p1, p2 of OpenCV.
constexpr double k1 = -0.2, k2 = 0.04, p1 = 0.006, p2 = -0.004;
const Lens opencv{LensModel::opencv, {k1, k2, p1, p2}};

Point distorted(const Point& m) {
  const auto [x, y] = m;
  const double q = x * x + y * y, radial = 1 + k1 * q + k2 * q * q;
  return {x * radial + 2 * p1 * x * y + p2 * (q + 2 * x * x),
          y * radial + p1 * (q + 2 * y * y) + 2 * p2 * x * y};
}

OtherMap drawn(const Camera& camera) {
  return other_map(render(shapes(), camera, {.channels = {Channel::Z}}).map);
}

/// With a ray for the centre of each pixel, made of its point in the plane where the lens distorts.
OtherMap drawn_by(const std::function<Point(const Point&)>& ray_of) {
  std::vector<double> numbers;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const auto [x, y] = ray_of(
          {(column + 0.5 - width / 2.) / focal_length, (row + 0.5 - height / 2.) / focal_length});
      numbers.insert(numbers.end(), {x, y, 1});
    }
  }
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(width, height, std::move(numbers));
  return drawn(camera);
}

/// The finding about a map that was to be drawn through a lens.
Finding finding_of(const OtherMap& map, const Lens& lens) {
  const Attribution found =
      judge_map("map", map, shapes(), camera_with(lens), std::nullopt).attribution;
  EXPECT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  return found.findings.empty() ? Finding{} : found.findings.front();
}

void expect_misread(const Lens& used, const Lens& right, const std::string& text) {
  const Finding finding = finding_of(drawn(camera_with(used)), right);
  EXPECT_EQ(finding.kind, "lens-convention");
  EXPECT_THAT(finding.text, HasSubstr(text));
  EXPECT_GT(finding.pixels, width * height / 4);
}

TEST(LensConventions, TheOrderOfTangentialTermsIsNamed) {
  expect_misread({LensModel::opencv, {k1, k2, p2, p1}}, opencv, "p1 and p2 of the lens OPENCV");
}

TEST(LensConventions, TheSignOfTheNumbersIsNamed) {
  expect_misread({LensModel::opencv, {-k1, -k2, -p1, -p2}}, opencv,
                 "the opposite sign of k1, k2, p1, p2: ");
  expect_misread({LensModel::opencv, {-k1, k2, p1, p2}}, opencv, "the opposite sign of k1: ");
  expect_misread({LensModel::opencv, {k1, k2, -p1, p2}}, opencv, "the opposite sign of p1: ");
}

TEST(LensConventions, NumbersThatAreLeftOutAreNamed) {
  expect_misread({LensModel::opencv, {k1, k2}}, opencv, "without p1, p2: ");
  expect_misread({LensModel::opencv, {k1}}, opencv, "without k2, p1, p2: ");
  expect_misread({LensModel::opencv, {0, k2, p1, p2}}, opencv, "without k1: ");
  expect_misread({LensModel::fisheye}, {LensModel::opencv_fisheye, {-0.04, 0.01, -0.003, 0.001}},
                 "without k1, k2, k3, k4: ");
}

TEST(LensConventions, TheFourthRadialTermOfOtherProgramsIsNamed) {
  const Lens brown{LensModel::brown, {k1, k2, 0.02, -0.02, p1, p2}};
  const Lens full{LensModel::full_opencv, {k1, k2, p1, p2, 0.02, -0.02}};
  expect_misread(full, brown, "OpenCV's k4 stands in the denominator");
  expect_misread(brown, full, "k4 is not the coefficient of r⁸");
  expect_misread({LensModel::full_opencv, {k1, k2, 0.02, -0.02, p1, p2}}, brown,
                 "OpenCV's order is k1 k2 p1 p2 k3");
}

TEST(LensConventions, PolynomialsInTheWrongVariableAreNamed) {
  const std::array<double, 14> numbers{-0.04, 0.01, -0.003, 0.001};
  const Lens fisheye{LensModel::opencv_fisheye, numbers};
  expect_misread({LensModel::brown, numbers}, fisheye, "the angle to the axis as variable");
  expect_misread({LensModel::opencv, numbers}, fisheye, "the angle to the axis as variable");
  expect_misread({LensModel::radial_fisheye, {k1, k2}}, {LensModel::radial, {k1, k2}},
                 "the radius in the plane as variable");
}

TEST(LensConventions, AnotherProjectionOfAFisheyeIsNamed) {
  expect_misread({LensModel::fisheye_equisolid}, {LensModel::fisheye},
                 "the projection is FISHEYE_EQUISOLID");
}

TEST(LensConventions, TheWrongDirectionIsNamed) {
  const Finding finding = finding_of(drawn_by(distorted), opencv);
  EXPECT_EQ(finding.kind, "lens-convention");
  EXPECT_THAT(finding.text, HasSubstr("applied in the wrong direction"));
}

/// A camera that is slightly wrong in a way that has no name for lenses.
using Spoil = void (*)(Camera&);
constexpr std::array<Spoil, 4> other_faults{
    [](Camera& camera) { camera.projection.cx += 0.3; },
    [](Camera& camera) { camera.projection.fx = camera.projection.fy = 1.01 * focal_length; },
    [](Camera& camera) { camera.projection.lens->distortion[0] *= 1.05; },
    [](Camera& camera) { camera.world_to_camera[0][3] += 0.02; }};

TEST(LensConventions, OtherFaultsAreNotTakenForThese) {
  for (const Lens& lens : {opencv, Lens{LensModel::radial, {k1, k2}},
                           Lens{LensModel::brown, {k1, k2, 0.02, -0.02, p1, p2}},
                           Lens{LensModel::opencv_fisheye, {-0.04, 0.01, -0.003, 0.001}}}) {
    for (const Spoil spoil : other_faults) {
      Camera camera = camera_with(lens);
      spoil(camera);
      const Attribution found =
          judge_map("map", drawn(camera), shapes(), camera_with(lens), std::nullopt).attribution;
      EXPECT_GT(found.count(PixelClass::unexplained), width * height / 4);
      for (const Finding& finding : found.findings)
        EXPECT_THAT(finding.kind, testing::Not(testing::AnyOf("lens-convention", "lens-inverse",
                                                              "remapped", "lens-ignored")));
    }
  }
}

/// OpenCV's steps.
Point fixed_point(const Point& given, int steps) {
  auto [x, y] = given;
  for (int step = 0; step < steps; ++step) {
    const double q = x * x + y * y, radial = 1 + k1 * q + k2 * q * q;
    const double dx = 2 * p1 * x * y + p2 * (q + 2 * x * x),
                 dy = p1 * (q + 2 * y * y) + 2 * p2 * x * y;
    x = (given.x - dx) / radial;
    y = (given.y - dy) / radial;
  }
  return {x, y};
}

Point by_residuals(const Point& given, int steps) {
  Point m = given;
  for (int step = 0; step < steps; ++step) {
    const Point shown = distorted(m);
    m = {m.x + given.x - shown.x, m.y + given.y - shown.y};
  }
  return m;
}

TEST(LensInverses, StepsThatStopEarlyAreCounted) {
  for (const int steps : {1, 3, 5}) {
    const Finding finding =
        finding_of(drawn_by([&](const Point& y) { return fixed_point(y, steps); }), opencv);
    EXPECT_EQ(finding.kind, "lens-inverse");
    EXPECT_THAT(finding.text, HasSubstr("stops after " + std::to_string(steps) + " step"));
    EXPECT_THAT(finding.text, HasSubstr("as in OpenCV"));
  }
}

TEST(LensInverses, OtherStepsAreNamedToo) {
  const Finding finding =
      finding_of(drawn_by([](const Point& y) { return by_residuals(y, 4); }), opencv);
  EXPECT_EQ(finding.kind, "lens-inverse");
  EXPECT_THAT(finding.text, HasSubstr("stops after 4 steps of the fixed point, by residuals"));
}

/// With differences in place of derivatives.
Point newton_step(const Point& given, const Point& m) {
  constexpr double h = 0x1p-16;
  const Point shown = distorted(m), right = distorted({m.x + h, m.y}),
              left = distorted({m.x - h, m.y}), below = distorted({m.x, m.y + h}),
              above = distorted({m.x, m.y - h});
  const double xx = (right.x - left.x) / (2 * h), yx = (right.y - left.y) / (2 * h),
               xy = (below.x - above.x) / (2 * h), yy = (below.y - above.y) / (2 * h);
  const double off_x = given.x - shown.x, off_y = given.y - shown.y, det = xx * yy - xy * yx;
  return {m.x + (yy * off_x - xy * off_y) / det, m.y + (xx * off_y - yx * off_x) / det};
}

TEST(LensInverses, NewtonsStepsAreNamed) {
  const Finding finding =
      finding_of(drawn_by([](const Point& y) { return newton_step(y, y); }), opencv);
  EXPECT_EQ(finding.kind, "lens-inverse");
  EXPECT_THAT(finding.text, HasSubstr("stops after 1 step of Newton's method"));
}

TEST(LensInverses, OneThatHasConvergedIsRight) {
  const OtherMap map = drawn_by([](const Point& y) { return by_residuals(y, 200); });
  const Attribution found =
      judge_map("map", map, shapes(), camera_with(opencv), std::nullopt).attribution;
  EXPECT_TRUE(found.findings.empty());
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
}

}  // namespace
}  // namespace fathom::attribution::lens_conventions
