// Maps of cameras with a lens: right ones, and ones with each fault that is known of lenses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/special_values.h"
#include "validation/scenes/shapes.h"

namespace fathom::attribution {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t width = 40, height = 30;
constexpr double focal = 27.5;

Mesh quad(const MeshPoint& a, const MeshPoint& b, const MeshPoint& c, const MeshPoint& d) {
  Mesh mesh;
  mesh.vertices = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  return mesh;
}

/// A tilted wall, a floor of large triangles and a sphere, in the frame of the camera.
std::vector<Mesh> shapes() {
  return {quad({-5, -4, 5.25}, {5, -4, 6.25}, {5, 4, 6.75}, {-5, 4, 5.75}),
          quad({-1.5, 1, 2.5}, {1.5, 1, 2.5}, {1.5, 1, 6}, {-1.5, 1, 6}),
          bench::sphere(500, {0.2, -0.1, 3.5}, 0.7)};
}

using Move = std::function<MeshPoint(const MeshPoint&)>;

Scene scene_of(const Move& move) {
  std::vector<Mesh> meshes = shapes();
  for (Mesh& mesh : meshes) {
    std::vector<MeshPoint> points(mesh.vertices.begin(), mesh.vertices.end());
    for (MeshPoint& p : points) p = move(p);
    mesh.vertices = std::move(points);
  }
  return bench::as_scene(std::move(meshes), "shapes");
}

/// A camera that is turned by 90° in the world, where the scene is turned with it.
Camera camera_with(const Lens& lens) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection = {.fx = focal, .fy = focal, .cx = 20, .cy = 15, .lens = lens};
  camera.world_to_camera = {{{0, 0, 1, 0.25}, {0, 1, 0, -0.5}, {-1, 0, 0, 2}}};
  return camera;
}
Scene scene_in_world() {
  return scene_of([](const MeshPoint& p) { return MeshPoint{2 - p.z, p.y + 0.5, p.x - 0.25}; });
}

/// The formulas of the models, of the plane at depth 1.
using Point = std::array<double, 2>;
Point distorted(const Lens& lens, const Point& m) {
  const auto [x, y] = m;
  const auto& d = lens.distortion;
  const double q = x * x + y * y;
  if (lens.model == LensModel::fov) {
    const double r = std::sqrt(q);
    const double factor = r == 0 ? 1 : std::atan(2 * r * std::tan(d[0] / 2)) / (r * d[0]);
    return {x * factor, y * factor};
  }
  if (lens.model == LensModel::simple_radial) return {x * (1 + d[0] * q), y * (1 + d[0] * q)};
  const double radial = 1 + d[0] * q + d[1] * q * q;
  return {x * radial + 2 * d[2] * x * y + d[3] * (q + 2 * x * x),
          y * radial + d[2] * (q + 2 * y * y) + 2 * d[3] * x * y};
}

/// The inverse by fixed points, as OpenCV does it; nothing where it does not come to rest.
std::optional<Point> undistorted(const Lens& lens, const Point& given) {
  Point m = given;
  for (int i = 0; i < 500; ++i) {
    const Point shown = distorted(lens, m);
    m = {m[0] + given[0] - shown[0], m[1] + given[1] - shown[1]};
  }
  const Point shown = distorted(lens, m);
  if (std::hypot(shown[0] - given[0], shown[1] - given[1]) > 1e-12) return std::nullopt;
  return m;
}

OtherMap drawn(const Scene& scene, const Camera& camera, Channel channel = Channel::Z) {
  return other_map(render(scene, camera, {.channels = {channel}}).map);
}

class LensMaps : public testing::TestWithParam<Lens> {
 protected:
  [[nodiscard]] Judgement judged(const OtherMap& other) const {
    return judge_map("map", other, scene_, camera_, std::nullopt);
  }
  /// The kind of the only finding.
  [[nodiscard]] std::string fault_of(const OtherMap& other) const {
    const Judgement found = judged(other);
    const auto& findings = found.attribution.findings;
    return findings.size() == 1 ? findings.front().kind
                                : std::to_string(findings.size()) + " findings";
  }
  [[nodiscard]] Camera pinhole() const {
    Camera camera = camera_;
    camera.projection.lens.reset();
    return camera;
  }
  [[nodiscard]] Camera moved(double x, double y) const {
    Camera camera = camera_;
    camera.projection.cx -= x;
    camera.projection.cy -= y;
    return camera;
  }

  Camera camera_ = camera_with(GetParam());
  Scene scene_ = scene_in_world();
};

TEST_P(LensMaps, ARightMapIsExplained) {
  const DepthMap map =
      render(scene_, camera_, {.channels = {Channel::Z, Channel::id, Channel::valid}}).map;
  const Judgement found = judged(other_map(map));
  EXPECT_EQ(found.attribution.count(PixelClass::equal), found.attribution.classes.size());
  EXPECT_TRUE(found.attribution.findings.empty())
      << cause_of(*found.truth, found.other, found.attribution);
  EXPECT_EQ(whole_camera(*found.truth).projection.lens, GetParam());
  // The corners see nothing through one of the lenses.
  const auto& valid = *map.values<std::uint32_t>("valid");
  const auto rays = std::count(valid.begin(), valid.end(), 1U);
  EXPECT_EQ(rays == width * height, GetParam().model != LensModel::simple_radial);
}

TEST_P(LensMaps, ALensThatIsLeftOutIsNamed) {
  EXPECT_EQ(fault_of(drawn(scene_, pinhole())), "lens-ignored");
}

TEST_P(LensMaps, StraightEdgesBetweenBentVerticesAreNamed) {
  const Scene bent = scene_of([](const MeshPoint& p) {
    const auto [x, y] = distorted(GetParam(), {p.x / p.z, p.y / p.z});
    return MeshPoint{x * p.z, y * p.z, p.z};
  });
  Camera camera = pinhole();
  camera.world_to_camera = Camera().world_to_camera;
  EXPECT_EQ(fault_of(drawn(bent, camera)), "straight-edges");
}

TEST_P(LensMaps, RemappedMapsOfAPinholeAreNamed) {
  const OtherMap straight = drawn(scene_, pinhole());
  OtherMap map = straight;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      double& depth = map.depths[std::size_t{row} * width + column];
      depth = infinity;
      const auto m =
          undistorted(GetParam(), {(column + 0.5 - 20) / focal, (row + 0.5 - 15) / focal});
      if (!m) continue;
      const double u = std::floor((*m)[0] * focal + 20), v = std::floor((*m)[1] * focal + 15);
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      depth = straight.depths[static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u)];
    }
  }
  map.values = map.depths;
  EXPECT_EQ(fault_of(map), "remapped");
}

TEST_P(LensMaps, ShiftsAreNamedWithTheirSize) {
  for (const Point& by : {Point{0.5, 0.5}, Point{-2, 1}}) {
    const Judgement found = judged(drawn(scene_, moved(by[0], by[1])));
    ASSERT_EQ(found.attribution.findings.size(), 1U);
    EXPECT_EQ(found.attribution.findings.front().kind, "shift");
    EXPECT_THAT(found.attribution.findings.front().text,
                HasSubstr(by[0] == 0.5 ? "(0.5, 0.5)" : "(-2, 1)"));
  }
}

TEST_P(LensMaps, DistancesInPlaceOfDepthsAreNamed) {
  EXPECT_EQ(fault_of(drawn(scene_, camera_, Channel::distance)), "ray-distance");
}

TEST_P(LensMaps, FaultsOfEveryCameraAreNamedToo) {
  OtherMap map = drawn(scene_, camera_);
  for (double& depth : map.depths) depth *= 1000;
  map.values = map.depths;
  EXPECT_EQ(fault_of(map), "scale");
}

TEST_P(LensMaps, OnePixelOfAnotherDepthOrSurfaceIsUnexplained) {
  const DepthMap map = render(scene_, camera_, {.channels = {Channel::Z, Channel::id}}).map;
  const std::size_t middle = std::size_t{height / 2} * width + width / 2;
  OtherMap nearer = other_map(map);
  nearer.depths[middle] *= 0.99;
  nearer.values = nearer.depths;
  OtherMap other_surface = other_map(map);
  other_surface.triangles[middle] = 0;
  for (const OtherMap& spoilt : {nearer, other_surface}) {
    const Judgement found = judged(spoilt);
    EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 1U);
    EXPECT_EQ(found.attribution.classes[middle], PixelClass::unexplained);
  }
}

TEST_P(LensMaps, ModelsOfRasterizersAreRefused) {
  Camera camera = camera_;
  camera.near = 1;
  camera.far = 10;
  try {
    (void)model_for("gl-unorm24", camera);
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a graphics pipeline draws straight edges"));
  }
}

INSTANTIATE_TEST_SUITE_P(OfThreeModels, LensMaps,
                         testing::Values(Lens{LensModel::simple_radial, {-0.2}},
                                         Lens{LensModel::opencv, {-0.15, 0.03, 0.004, -0.003}},
                                         Lens{LensModel::fov, {1.1}}),
                         [](const auto& lens) { return std::string(name_of(lens.param.model)); });

// Depths along z are compared, so every ray has to go forwards.
TEST(LensMapsToAllSides, AreRefused) {
  const Camera camera = camera_with({LensModel::division, {-3}});
  const OtherMap other{.width = width,
                       .height = height,
                       .depths = std::vector<double>(std::size_t{width} * height, 1)};
  try {
    (void)judge_map("map", other, scene_in_world(), camera, std::nullopt);
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the lens DIVISION: some rays do not go forwards"));
  }
}

}  // namespace
}  // namespace fathom::attribution
