#include "fathom/camera/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using testing::HasSubstr;
Camera small_camera() {
  Camera camera;
  camera.width = 4;
  camera.height = 2;
  return camera;
}

TEST(Camera, PerspectiveOnPaper) {
  // 2 units right, 1 down, 4 in front; fx 8 and skew 2 give u = (8·2 + 2·1)/4 + 3 = 7.5.
  Camera camera = small_camera();
  camera.projection.fx = 8, camera.projection.fy = 4, camera.projection.cx = 3,
  camera.projection.cy = 5, camera.projection.skew = 2;
  const auto [U, V, W] = to_image(camera.projection, CameraPoint{2.0, 1.0, 4.0});
  EXPECT_EQ(U, Dyadic(30.0));
  EXPECT_EQ(V, Dyadic(24.0));
  EXPECT_EQ(W, Dyadic(4.0));
}

TEST(Camera, OrthographicOnPaper) {
  Camera camera = small_camera();
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.fx = 8, camera.projection.fy = 4, camera.projection.cx = 3,
  camera.projection.cy = 5, camera.projection.skew = 2;
  const auto [U, V, W] = to_image(camera.projection, CameraPoint{2.0, 1.0, 4.0});
  EXPECT_EQ(U, Dyadic(21.0));
  EXPECT_EQ(V, Dyadic(9.0));
  EXPECT_EQ(W, Dyadic(1.0));
}

TEST(Camera, PixelCentreMovesTheImageByExactlyItsDifferenceToAHalf) {
  for (const auto projection : {ProjectionModel::perspective, ProjectionModel::orthographic}) {
    Camera corner = small_camera();
    corner.projection.model = projection;
    corner.projection.cx = 0.1,
    corner.projection.cy = 1e-30;  // adding ½ in binary64 would round both
    Camera centre = corner;
    centre.projection.pixel_centre = 0;
    const CameraPoint p{0.3, 0.7, 1.9};
    const auto a = to_image(corner.projection, p), b = to_image(centre.projection, p);
    EXPECT_EQ(b.U - a.U, Dyadic(0.5) * a.W);
    EXPECT_EQ(b.V - a.V, Dyadic(0.5) * a.W);
  }
}

TEST(Camera, TheWayBackToTheWorldOnPaper) {
  // x' = 2z + 1, y' = −x, z' = 3y: x = −y', y = z'/3, z = (x' − 1)/2.
  Camera camera = small_camera();
  camera.world_to_camera = {{{0, 0, 2, 1}, {-1, 0, 0, 0}, {0, 3, 0, 0}}};
  const std::array<std::array<double, 4>, 3> back{
      {{0, -1, 0, 0}, {0, 0, 1.0 / 3, 0}, {0.5, 0, 0, -0.5}}};
  EXPECT_EQ(camera_to_world(camera.world_to_camera), back);
  camera.world_to_camera[2] = camera.world_to_camera[1];
  EXPECT_THROW(camera_to_world(camera.world_to_camera), InputError);
}

TEST(Camera, ThePrincipalPointCountsFromTheCornerOfTheImage) {
  Camera camera = small_camera();
  camera.projection.cx = 3, camera.projection.cy = 5;
  for (const double pixel_centre : {0.5, 0.0, 0.25}) {
    camera.projection.pixel_centre = pixel_centre;
    const auto [U, V, W] = to_image(camera.projection, CameraPoint{0.0, 0.0, 1.0});
    const auto [x, y] = principal_point(camera.projection);
    EXPECT_EQ(U, Dyadic(x) * W);
    EXPECT_EQ(V, Dyadic(y) * W);
  }
}

TEST(Camera, WorldToCameraIsNotRounded) {
  Camera camera = small_camera();
  camera.world_to_camera = {{{1e150, 1, 0, 1e-150}, {0, 1, 0, -1e300}, {0, 0, 0x1p-1000, 3}}};
  const CameraPoint p = to_camera(camera.world_to_camera, WorldPoint{1e150, 0x1p-1074, 0x1p-1074});
  EXPECT_EQ(p.x, Dyadic(1e150) * Dyadic(1e150) + Dyadic(0x1p-1074) + Dyadic(1e-150));
  EXPECT_EQ(p.y, Dyadic(0x1p-1074) - Dyadic(1e300));
  EXPECT_EQ(p.z - Dyadic(3.0), Dyadic(1.0).scaled(-2074));
}

TEST(Camera, AgreesWithIntegerArithmetic) {
  // Small integers: every product and sum below is exact in 64 bits.
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(-50, 50);
  for (int round = 0; round < 2000; ++round) {
    Camera camera = small_camera();
    long m[3][4], X[3], k[5];
    for (auto& row : m)
      for (long& x : row) x = any(random);
    for (long& x : X) x = any(random);
    for (long& x : k) x = any(random);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) camera.world_to_camera[i][j] = static_cast<double>(m[i][j]);
    camera.projection.fx = static_cast<double>(k[0]),
    camera.projection.fy = static_cast<double>(k[1]);
    camera.projection.cx = static_cast<double>(k[2]),
    camera.projection.cy = static_cast<double>(k[3]);
    camera.projection.skew = static_cast<double>(k[4]);
    long p[3];
    for (int i = 0; i < 3; ++i) p[i] = m[i][0] * X[0] + m[i][1] * X[1] + m[i][2] * X[2] + m[i][3];
    const auto number = [](long x) { return Dyadic(static_cast<double>(x)); };
    const CameraPoint q =
        to_camera(camera.world_to_camera, WorldPoint{number(X[0]), number(X[1]), number(X[2])});
    ASSERT_EQ(q.x, number(p[0]));
    ASSERT_EQ(q.y, number(p[1]));
    ASSERT_EQ(q.z, number(p[2]));
    const auto image = to_image(camera.projection, q);
    ASSERT_EQ(image.U, number(k[0] * p[0] + k[4] * p[1] + k[2] * p[2]));
    ASSERT_EQ(image.V, number(k[1] * p[1] + k[3] * p[2]));
    ASSERT_EQ(image.W, number(p[2]));
    const long det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    ASSERT_EQ(determinant_of_rotation(camera.world_to_camera), number(det));
  }
}

TEST(Camera, AcceptsWhatTheSpecificationAllows) {
  EXPECT_EQ(find_fault(small_camera()), std::nullopt);
  Camera camera = small_camera();
  camera.projection.fx = -1e150, camera.projection.fy = 0x1p-1074, camera.projection.skew = -3,
  camera.projection.pixel_centre = -7;
  camera.near = 1, camera.far = std::nextafter(1.0, 2.0);
  EXPECT_EQ(find_fault(camera), std::nullopt);
  // In floating point its determinant is 0; it is 2⁻²¹⁴⁸.
  camera.world_to_camera = {{{0x1p-1074, 0, 0, 0}, {0, 0x1p-1074, 0, 0}, {0, 0, 1, 0}}};
  EXPECT_EQ(find_fault(camera), std::nullopt);
}

struct Fault {
  const char* expected;
  void (*spoil)(Camera&);
};

TEST(Camera, NamesEveryFault) {
  const Fault faults[] = {
      {"width", [](Camera& c) { c.width = 0; }},
      {"height", [](Camera& c) { c.height = 0; }},
      {"fx is 0", [](Camera& c) { c.projection.fx = 0; }},
      {"fy is 0", [](Camera& c) { c.projection.fy = -0.0; }},
      {"fx is not", [](Camera& c) { c.projection.fx = nan; }},
      {"fy is not", [](Camera& c) { c.projection.fy = infinity; }},
      {"cx is not", [](Camera& c) { c.projection.cx = -infinity; }},
      {"cy is not", [](Camera& c) { c.projection.cy = nan; }},
      {"skew is not", [](Camera& c) { c.projection.skew = nan; }},
      {"pixel_centre is not", [](Camera& c) { c.projection.pixel_centre = nan; }},
      {"world_to_camera has", [](Camera& c) { c.world_to_camera[2][3] = nan; }},
      {"near is not", [](Camera& c) { c.near = nan; }},
      {"near is not", [](Camera& c) { c.near = infinity; }},
      {"near is negative", [](Camera& c) { c.near = -1; }},
      {"far", [](Camera& c) { c.far = nan; }},
      {"far", [](Camera& c) { c.far = c.near; }},
      {"far", [](Camera& c) { c.far = -infinity; }},
      {"singular",
       [](Camera& c) {
         c.world_to_camera[1] = {0, 0, 0, 1};
       }},
      // Rows that are multiples of each other: only exactly is the determinant 0.
      {"singular",
       [](Camera& c) {
         c.world_to_camera[0] = {0.1, 0.7, -0.3, 0};
         c.world_to_camera[1] = {0.2, 1.4, -0.6, 5};
       }},
  };
  for (const auto& [expected, spoil] : faults) {
    Camera camera = small_camera();
    spoil(camera);
    const auto fault = find_fault(camera);
    ASSERT_TRUE(fault.has_value()) << expected;
    EXPECT_THAT(*fault, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace fathom
