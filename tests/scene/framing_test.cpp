#include "fathom/scene/framing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/scene/bounds.h"
#include "tests/camera/seen_points.h"
#include "tests/effort.h"
#include "tests/inputs/scene_of_points.h"
#include "tests/scratch_folder.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;
constexpr Vector3 y_up{0, 1, 0}, z_up{0, 0, 1};

/// Whether a point projects into the part of the image that a margin of a twentieth leaves. Exact.
bool inside_margin(const Camera& camera, const MeshPoint& p) {
  const auto [U, V, W] =
      to_image(camera.projection, to_camera(camera.world_to_camera, WorldPoint{p.x, p.y, p.z}));
  const Dyadic w = camera.width, h = camera.height, twenty = 20.0;
  return W.sign() == Sign::positive && twenty * U >= w * W && twenty * U <= Dyadic(19.0) * w * W &&
         twenty * V >= h * W && twenty * V <= Dyadic(19.0) * h * W;
}

void expect_sees_all(const Camera& camera, const std::vector<MeshPoint>& vertices) {
  ASSERT_EQ(find_fault(camera), std::nullopt);
  for (const MeshPoint& p : vertices)
    ASSERT_TRUE(inside_margin(camera, p)) << p.x << " " << p.y << " " << p.z;
}

struct NamedVertices {
  const char* name;
  std::vector<MeshPoint> vertices;
};

std::vector<MeshPoint> cloud(const Vector3& centre, const Vector3& size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<MeshPoint> points;
  for (int i = 0; i < std::max(4, 50 / checks::effort); ++i)
    points.push_back({centre[0] + size[0] * any(random), centre[1] + size[1] * any(random),
                      centre[2] + size[2] * any(random)});
  return points;
}

std::vector<NamedVertices> trouble() {
  const double tiny = 0x1p-1074;
  return {{"a cloud", cloud({}, {1, 2, 3})},
          {"1e150", cloud({1e150, 0, 0}, {1e150, 1e149, 1e150})},
          {"1e300", cloud({}, {1e300, 1e300, 1e300})},
          {"1e-150", cloud({}, {1e-150, 1e-150, 1e-150})},
          {"subnormal", {{0, 0, 0}, {tiny, 3 * tiny, -tiny}}},
          {"subnormal point", {{tiny, -tiny, tiny}}},
          {"flat in x", cloud({}, {0, 1, 1})},
          {"flat in y", cloud({}, {1, 0, 1})},
          {"flat in z", cloud({}, {1, 1, 0})},
          {"a line", cloud({}, {0, 0, 1})},
          {"a point", {{3, -4, 5}}},
          {"the origin", {{0, 0, 0}}},
          {"UTM", cloud({500000, 5400000, 300}, {20, 30, 5})},
          {"a millimetre at UTM", cloud({500000, 5400000, 300}, {1e-3, 1e-3, 1e-3})},
          {"an ulp far away", {{1e20, -1e20, 1e20}, {1e20, -1e20, 1e20 + 16384}}},
          {"a point far away", {{1e200, 1e100, 1}}},
          {"a needle", cloud({}, {1e100, 1, 1e-100})}};
}

TEST(Frame, SeesAllOfEveryScene) {
  int drawn = 0;
  for (const auto& [name, vertices] : trouble()) {
    SCOPED_TRACE(name);
    const Scene scene = checks::scene_of_points(vertices);
    for (const auto projection : {ProjectionModel::perspective, ProjectionModel::orthographic})
      for (const Vector3& up : {y_up, z_up, Vector3{-1, 0, 0}, Vector3{0.3, -1e-5, 0.7}})
        for (const double azimuth : {0.0, 35.0, 90.0, 250.0})
          for (const double elevation : {-90.0, -30.0, 0.0, 25.0, 90.0})
            for (const double fov : {1.0, 40.0, 150.0}) {
              if (++drawn % checks::effort != 0) continue;
              LensChoice lens;
              lens.model = projection;
              lens.vertical_fov = fov;
              expect_sees_all(frame_scene(scene, {azimuth, elevation, up}, lens), vertices);
            }
  }
}

TEST(Frame, FillsTheImageButForItsMargin) {
  for (const auto projection : {ProjectionModel::perspective, ProjectionModel::orthographic}) {
    LensChoice lens;
    lens.model = projection;
    lens.width = 300, lens.height = 400;
    const WorldBounds bounds{{-1, -2, -3}, {3, 2, 1}};
    const Camera camera = frame(bounds, {}, lens);
    test::Real reach = 0;
    for (int i = 0; i < 8; ++i) {
      const test::Seen at = test::seen(
          camera,
          {(i & 1) != 0 ? 3.0 : -1.0, (i & 2) != 0 ? 2.0 : -2.0, (i & 4) != 0 ? 1.0 : -3.0});
      reach = std::max({reach, std::abs(at.u - 150) / 150, std::abs(at.v - 200) / 200});
    }
    EXPECT_LE(reach, 0.9L);
    EXPECT_GT(reach, 0.9 - 1e-9);  // the estimate is 2⁻⁴⁰ too large on purpose
  }
}

TEST(Frame, AnOrbitSeesAllFromEverywhere) {
  for (const auto& [name, vertices] : trouble()) {
    SCOPED_TRACE(name);
    const auto bounds = world_bounds(checks::scene_of_points(vertices));
    ASSERT_TRUE(bounds);
    const auto path = orbit({0, 20, z_up}, 7, *bounds);
    ASSERT_EQ(path.size(), 7U);
    for (const Camera& camera : path) expect_sees_all(camera, vertices);
  }
}

TEST(Frame, PanoramasStandWhereThePinholeStands) {
  LensChoice lens;
  const WorldBounds bounds{{-1, -1, -1}, {1, 2, 3}};
  const Camera pinhole = frame(bounds, {}, lens);
  lens.distortion = Lens{LensModel::equirectangular};
  const Camera panorama = frame(bounds, {}, lens);
  EXPECT_EQ(panorama.world_to_camera, pinhole.world_to_camera);
  EXPECT_EQ(panorama.projection.fx, lens.width);
  EXPECT_EQ(panorama.projection.fy, lens.height);
  EXPECT_EQ(panorama.projection.lens, lens.distortion);
}

TEST(Frame, KeepsAGivenExtent) {
  LensChoice lens;
  lens.model = ProjectionModel::orthographic;
  lens.vertical_extent = 1;  // less than the scene
  const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, {}, lens);
  EXPECT_EQ(camera.projection.fx, 720);
  for (int i = 0; i < 8; ++i)
    EXPECT_GT(test::seen(camera, {(i & 1) != 0 ? 1. : -1., (i & 2) != 0 ? 1. : -1.,
                                  (i & 4) != 0 ? 1. : -1.})
                  .depth,
              0);
}

TEST(Frame, RefusesWhatCannotBe) {
  EXPECT_THAT(message_of<InputError>([] { frame_scene(Scene()); }), HasSubstr("no triangle"));
  const double most = std::numeric_limits<double>::max();
  EXPECT_THAT(message_of<InputError>([&] {
                frame({{-most, -most, -most}, {most, most, most}});
              }),
              HasSubstr("no camera with finite numbers"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{0, 0, 0}, {infinity, 1, 1}});
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{}, {1, 1, 1}}, {0, 91, y_up});
              }),
              HasSubstr("elevation"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{}, {1, 1, 1}}, {infinity, 1, y_up});
              }),
              HasSubstr("azimuth"));
}
}  // namespace
}  // namespace fathom
