#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fathom/render.h"
#include "fathom/scene/framing.h"
#include "tests/validation/bench/covered_share.h"
#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/random.h"
#include "validation/scenes/scenes.h"
#include "validation/scenes/shapes.h"

/// scan, city, tree, text and cad have what they are there for.
namespace fathom::bench {
namespace {

using Point = std::array<double, 3>;
using Corners = std::array<Point, 3>;

Point seen(const Camera& camera, const MeshPoint& p) {
  Point q{};
  for (int r = 0; r < 3; ++r) {
    const auto& row = camera.world_to_camera[r];
    q[r] = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
  }
  return q;
}

/// The triangles of a scene of one mesh, in the camera's frame.
std::vector<Corners> triangles_of(const BenchScene& bench) {
  std::vector<Corners> triangles;
  const Mesh& mesh = bench.scene.meshes.at(0);
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({seen(bench.camera, mesh.vertices[a]), seen(bench.camera, mesh.vertices[b]),
                         seen(bench.camera, mesh.vertices[c])});
  }
  return triangles;
}

int corners_behind(const Corners& t) {
  return static_cast<int>(std::count_if(t.begin(), t.end(), [](auto& p) { return p[2] <= 0; }));
}

double length(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double area(const Corners& t) {
  const Point u{t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]};
  const Point v{t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]};
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]) /
         2;
}

/// The longest side over the height on it.
double slenderness(const Corners& t) {
  const double side = std::max({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])});
  return side * side / (2 * area(t));
}

/// Pixels that a triangle in front of the camera would cover.
double pixels(const Camera& camera, Corners t) {
  for (Point& p : t)
    p = {camera.projection.fx * p[0] / p[2], camera.projection.fy * p[1] / p[2], 0};
  return area(t);
}

/// The value that a share of the measures of all triangles does not exceed.
template <typename Measure>
double quantile(const std::vector<Corners>& triangles, double share, const Measure& measure) {
  std::vector<double> values;
  for (const Corners& t : triangles) values.push_back(measure(t));
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

TEST(BenchNoise, IsSmoothAndBoundedAndTheSameEverywhere) {
  double least = 1, most = -1;
  for (int i = -400; i < 400; ++i) {
    const double value = value_noise({0.1 * i, 0.07 * i, -0.03 * i}, 5);
    const double next = value_noise({0.1 * i + 1e-6, 0.07 * i, -0.03 * i}, 5);
    least = std::min(least, value);
    most = std::max(most, value);
    EXPECT_NEAR(value, next, 4e-6);  // slopes are at most 2 · 3/2
  }
  EXPECT_GE(least, -1);
  EXPECT_LT(least, -0.5);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.5);
  EXPECT_EQ(value_noise({-3.25, 4.5, 0.125}, 7), 0x1.75c1f3c1a830ep-4);
}

TEST(BenchScan, HasAMillionTrianglesOfUnevenSizes) {
  const BenchScene bench = make_scene("scan", 1920, 1080);
  const std::vector<Corners> triangles = triangles_of(bench);
  EXPECT_GT(triangles.size(), 950'000U);
  EXPECT_LT(triangles.size(), 1'050'000U);
  EXPECT_GT(quantile(triangles, 0.99, area), 10 * quantile(triangles, 0.05, area));
  const double median =
      quantile(triangles, 0.5, [&](const Corners& t) { return pixels(bench.camera, t); });
  EXPECT_GT(median, 0.5);
  EXPECT_LT(median, 2);
}

// An edge is passed once in each direction, but at the border of a hole.
TEST(BenchScan, HasHolesLargeAndSmall) {
  const Mesh mesh = scan(20'000);
  std::set<std::pair<std::uint32_t, std::uint32_t>> passed;
  for (const CornerIndices& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(passed.insert({t[k], t[(k + 1) % 3]}).second);
  }
  std::size_t open = 0;
  for (const auto& [a, b] : passed) open += 1 - passed.count({b, a});
  const std::size_t gone = 20'000 - mesh.triangles.size();  // of sphere(20'000)
  EXPECT_GT(gone, 200U);
  EXPECT_LT(gone, 2'000U);
  EXPECT_GT(open, 100U);
  EXPECT_LT(open, 3 * gone / 2);  // patches, too: their triangles adjoin
}

TEST(BenchCity, CrossesThePlaneOfTheCameraWithLongThinTriangles) {
  const BenchScene bench = make_scene("city", 1920, 1080);
  const std::vector<Corners> triangles = triangles_of(bench);
  EXPECT_GT(triangles.size(), 300'000U);
  const auto crossing = std::count_if(triangles.begin(), triangles.end(),
                                      [](const Corners& t) { return corners_behind(t) % 3 != 0; });
  EXPECT_GT(crossing, 1000);
  EXPECT_GT(quantile(triangles, 0.5, slenderness), 50);
}

TEST(BenchCity, IsSeenFromWithin) {
  const BenchScene bench = make_scene("city", 320, 180);
  const std::vector<Corners> triangles = triangles_of(bench);
  const auto behind = std::count_if(triangles.begin(), triangles.end(),
                                    [](const Corners& t) { return corners_behind(t) == 3; });
  const double share = static_cast<double>(behind) / static_cast<double>(triangles.size());
  EXPECT_NEAR(share, 0.5, 0.1);
  const double covered = checks::covered_share(bench);
  EXPECT_GT(covered, 0.85);  // all but the sky
  EXPECT_LT(covered, 1);
}

TEST(BenchTree, ItsLeavesAreBelowAPixel) {
  const BenchScene bench = make_scene("tree", 1920, 1080);
  const std::vector<Corners> triangles = triangles_of(bench);
  // 4⁶ twigs with 150 leaves of two triangles; 1 + 4 + … + 4⁶ branches of six sides.
  EXPECT_EQ(triangles.size(), 4096U * 150 * 2 + 5461 * 12);
  const auto size = [&](const Corners& t) { return pixels(bench.camera, t); };
  EXPECT_LT(quantile(triangles, 0.5, size), 0.2);
  EXPECT_LT(quantile(triangles, 0.9, size), 0.5);
  EXPECT_GT(quantile(triangles, 1, size), 1000);  // the trunk
  const double covered = checks::covered_share(bench);
  EXPECT_GT(covered, 0.08);
  EXPECT_LT(covered, 0.25);
}

TEST(BenchText, IsOfSliversThatFaceTheReader) {
  const BenchScene bench = make_scene("text", 1920, 1080);
  const std::vector<Corners> triangles = triangles_of(bench);
  EXPECT_GT(triangles.size(), 400'000U);
  EXPECT_GT(quantile(triangles, 0.5, slenderness), 4);
  EXPECT_GT(quantile(triangles, 0.8, slenderness), 10);
  const Mesh& mesh = bench.scene.meshes[0];
  for (const auto& [a, b, c] : mesh.triangles) {
    const MeshPoint &A = mesh.vertices[a], &B = mesh.vertices[b], &C = mesh.vertices[c];
    ASSERT_GT((B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x), 0);
  }
  const double covered = checks::covered_share(bench);
  EXPECT_GT(covered, 0.1);
  EXPECT_LT(covered, 0.3);
}

TEST(BenchCad, IsOfFansAndSlivers) {
  const BenchScene bench = make_scene("cad", 1920, 1080);
  const std::vector<Corners> triangles = triangles_of(bench);
  EXPECT_GT(triangles.size(), 400'000U);
  EXPECT_GT(quantile(triangles, 0.5, slenderness), 8);
  EXPECT_GT(quantile(triangles, 0.99, slenderness), 500);  // along the rods
  std::map<std::uint32_t, int> used;
  for (const CornerIndices& t : bench.scene.meshes[0].triangles) {
    for (const std::uint32_t corner : t) ++used[corner];
  }
  const auto most = std::max_element(used.begin(), used.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  EXPECT_GE(most->second, 358);  // a rod's end
  const double covered = checks::covered_share(bench);
  EXPECT_GT(covered, 0.35);
  EXPECT_LT(covered, 0.6);
}

struct Small {
  std::string name;
  Mesh (*make)();
};

void PrintTo(const Small& small, std::ostream* stream) {
  *stream << small.name;
}

class SmallScenes : public testing::TestWithParam<Small> {};

TEST_P(SmallScenes, BothEnginesSeeTheSame) {
  const Scene scene = as_scene({GetParam().make()}, GetParam().name);
  const Camera camera = GetParam().name == "city"
                            ? make_scene("city", 64, 36).camera
                            : frame_scene(scene, {}, {.width = 64, .height = 36});
  const DepthMap fast = render(scene, camera, {.engine = Engine::fast}).map;
  const DepthMap reference = render(scene, camera, {.engine = Engine::reference}).map;
  EXPECT_EQ(*fast.values<float>("Z"), *reference.values<float>("Z"));
}

INSTANTIATE_TEST_SUITE_P(All, SmallScenes,
                         testing::Values(Small{"scan", [] { return scan(5'000); }},
                                         Small{"city", [] { return city(4); }},
                                         Small{"tree", [] { return tree(3, 30); }},
                                         Small{"text", [] { return text_page(2); }},
                                         Small{"cad", [] { return machine_part(4); }}),
                         [](const auto& small) { return small.param.name; });

}  // namespace
}  // namespace fathom::bench
