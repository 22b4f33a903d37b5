#include <gtest/gtest.h>

#include <cmath>

#include "fathom/rays/sight.h"
#include "tests/effort.h"
#include "tests/evaluation/rational_judge.h"
#include "tests/evaluation/scenes.h"

namespace fathom::evaluation {
namespace {

/// A camera somewhere around a soup of that size, with whole numbers so that much coincides.
Camera some_camera(std::mt19937& random, int size) {
  Camera camera = checks::camera_of(16, 12, 4);
  const auto from = [&](int least, int greatest) {
    return static_cast<double>(least + static_cast<int>(random() % (greatest - least + 1)));
  };
  const double far_away = random() % 5 == 0 ? 0x1p20 : 1;
  do {
    for (auto& row : camera.world_to_camera) {
      for (std::size_t k = 0; k < 3; ++k) row[k] = from(-1, 1);
      row[3] = far_away * from(-2 * size, 2 * size);
    }
  } while (find_fault(camera));
  if (random() % 3 == 0) camera.projection.model = ProjectionModel::orthographic;
  if (random() % 3 == 0) camera.near = far_away * from(0, size);
  if (random() % 3 == 0) camera.far = camera.near + far_away * from(1, 2 * size);
  if (random() % 4 == 0) camera.projection.fx = -camera.projection.fx;
  if (random() % 4 == 0) camera.projection.skew = from(-1, 1);
  return camera;
}

/// A scene that is prepared.
class Checked {
 public:
  explicit Checked(const Scene& scene) : scene_(scene) {}

  [[nodiscard]] bool sees(const SightPoint& point, const Camera& camera, Cull cull) const {
    return seen_by(scene_, std::array{point}, std::array{camera}, cull, 1).front();
  }

 private:
  RayScene scene_;
};

/// A place near a soup of that size, or far away.
SightPoint some_place(std::mt19937& random, int size, double factor) {
  const double step = factor * (random() % 8 == 0 ? 0x1p20 : 0.5);
  std::array<double, 3> place;
  for (double& x : place)
    x = step * (static_cast<int>(random() % static_cast<unsigned>(4 * size + 1)) - 2 * size);
  return place;
}

SurfacePoint some_point(std::mt19937& random, std::uint32_t triangles) {
  // Corners, the middle of edges and of the triangle, where much meets; and any place.
  const double grid = random() % 2 == 0 ? 4 : 0x1p25;
  const double u = std::floor(grid * (random() % 1001) / 1000) / grid;
  const double v = std::floor((grid - grid * u) * (random() % 1001) / 1000) / grid;
  return {static_cast<std::uint32_t>(random() % triangles), u, v};
}

std::string text_of(const SightPoint& point) {
  const auto text = [](double a, double b, double c) {
    return std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c);
  };
  if (const auto* const place = std::get_if<std::array<double, 3>>(&point))
    return "at " + text((*place)[0], (*place)[1], (*place)[2]);
  const auto& on_surface = std::get<SurfacePoint>(point);
  return "triangle, v, w: " + text(on_surface.triangle, on_surface.v, on_surface.w);
}

void expect_as_by_rationals(double factor, unsigned seed, int rounds) {
  std::mt19937 random(seed);
  constexpr std::array culls{Cull::none, Cull::back, Cull::front};
  int seen = 0, all = 0;
  for (int round = 0; round < rounds / checks::effort; ++round) {
    const int size = 2 + static_cast<int>(random() % 6);
    const std::uint32_t triangles = 1 + random() % 20;
    const Scene scene =
        test::scaled(test::whole_soup(random, size, static_cast<int>(triangles)), factor);
    const RayScene prepared(scene, 1);
    for (int view = 0; view < 4; ++view) {
      Camera camera = some_camera(random, size);
      for (auto& row : camera.world_to_camera) row[3] *= factor;
      camera.near *= factor;
      camera.far *= factor;
      if (is_orthographic(camera.projection)) {
        camera.projection.fx /= factor;
        camera.projection.fy /= factor;
        camera.projection.skew /= factor;
      }
      const Cull cull = culls[random() % 3];
      std::vector<SightPoint> points;
      for (int i = 0; i < 20; ++i) {
        const bool on_surface = random() % 4 != 0;
        points.push_back(on_surface ? SightPoint(some_point(random, triangles))
                                    : some_place(random, size, factor));
      }
      const auto found = seen_by(prepared, points, std::array{camera}, cull, 1);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool expected = test::is_seen(scene, points[i], camera, cull);
        ASSERT_EQ(found[i], expected) << "round " << round << ", " << text_of(points[i]);
        seen += expected;
        ++all;
      }
    }
  }
  EXPECT_GT(seen, all / 50);
  EXPECT_LT(seen, all / 2);
}

TEST(PointSight, IsThatOfRationalNumbers) {
  expect_as_by_rationals(1, 1, 400);
}

TEST(PointSight, IsThatOfRationalNumbersInUnitsThatBinary64HardlyHas) {
  expect_as_by_rationals(0x1p900, 2, 60);
  expect_as_by_rationals(0x1p-900, 3, 60);
}

/// A wall at z = 2 before a wall at z = 4.
Scene two_walls() {
  return checks::scene_of({{-1, -1, 2},
                           {1, -1, 2},
                           {1, 1, 2},
                           {-1, 1, 2},
                           {-4, -4, 4},
                           {4, -4, 4},
                           {4, 4, 4},
                           {-4, 4, 4}},
                          {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
}

TEST(PointSight, OfAPointBehindTheRimOfAWall) {
  const Scene scene = two_walls();
  const Checked checked(scene);
  const Camera camera = checks::camera_of(100, 100, 25);
  // The wall in front hides x and y up to 2 of the one behind; its rim belongs to it.
  const auto at = [](double x, double y) {
    // Of triangle 2: (−4, −4), (4, −4), (4, 4).
    return SurfacePoint{2, (x - y) / 8, (y + 4) / 8};
  };
  EXPECT_FALSE(checked.sees(at(1, 0), camera, Cull::none));
  EXPECT_FALSE(checked.sees(at(2, 0), camera, Cull::none));
  EXPECT_TRUE(checked.sees(at(2 + 0x1p-20, 0), camera, Cull::none));
  EXPECT_TRUE(checked.sees(SurfacePoint{0, 0.25, 0.25}, camera, Cull::none));
}

TEST(PointSight, EndsAtTheRimOfTheImage) {
  const Scene scene = two_walls();
  const Checked checked(scene);
  // The image ends at x/z = 0.75.
  Camera camera = checks::camera_of(100, 100, 50 / 0.75);
  camera.projection.fx = camera.projection.fy = 64;
  camera.width = camera.height = 96;
  camera.projection.cx = camera.projection.cy = 48;
  const auto at = [](double x) { return SurfacePoint{2, x / 8, 0.5}; };
  EXPECT_TRUE(checked.sees(at(3), camera, Cull::none));
  EXPECT_FALSE(checked.sees(at(3 + 0x1p-20), camera, Cull::none));
}

TEST(PointSight, OfTwoSurfacesInOnePlace) {
  Scene scene = two_walls();
  scene.meshes[0].triangles.push_back({4, 5, 6});
  const Checked checked(scene);
  const Camera camera = checks::camera_of(100, 100, 12);
  EXPECT_TRUE(checked.sees(SurfacePoint{2, 0.25, 0.125}, camera, Cull::none));
  EXPECT_TRUE(checked.sees(SurfacePoint{4, 0.25, 0.125}, camera, Cull::none));
}

}  // namespace
}  // namespace fathom::evaluation
