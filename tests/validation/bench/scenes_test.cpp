#include "validation/scenes/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fathom/render.h"
#include "tests/validation/bench/covered_share.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {
namespace {

using Vector3 = std::array<double, 3>;

Vector3 difference(const MeshPoint& a, const MeshPoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Every edge of a closed, consistently oriented surface is passed once in each direction.
void expect_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
  for (const CornerIndices& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++passed[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : passed) {
    EXPECT_EQ(count, 1) << edge.first << " " << edge.second;
    EXPECT_EQ(passed.count({edge.second, edge.first}), 1U) << edge.first << " " << edge.second;
  }
}

TEST(BenchScenes, SpheresAreClosedAndFaceOutwards) {
  for (const std::uint64_t triangles : {8, 32, 72, 800}) {
    const Mesh mesh = sphere(triangles);
    EXPECT_EQ(mesh.triangles.size(), triangles);
    EXPECT_EQ(mesh.vertices.size(), triangles / 2 + 2);  // Euler's formula
    expect_closed(mesh);
    for (const auto& [a, b, c] : mesh.triangles) {
      const MeshPoint& A = mesh.vertices[a];
      const Vector3 u = difference(mesh.vertices[b], A), v = difference(mesh.vertices[c], A);
      const double volume = A.x * (u[1] * v[2] - u[2] * v[1]) + A.y * (u[2] * v[0] - u[0] * v[2]) +
                            A.z * (u[0] * v[1] - u[1] * v[0]);
      EXPECT_GT(volume, 0);
    }
  }
}

TEST(BenchScenes, NamesSayHowManyTriangles) {
  EXPECT_EQ(triangle_count(make_scene("sphere-20k", 64, 36).scene), 20'000U);
  EXPECT_EQ(triangle_count(make_scene("sphere-200k", 64, 36).scene), 199'712U);
  EXPECT_EQ(triangle_count(make_scene("sphere-512", 64, 36).scene), 512U);
  EXPECT_EQ(triangle_count(make_scene("mesh", 64, 36).scene), 6320U);
  EXPECT_EQ(triangle_count(make_scene("grid-aligned", 1000, 1000).scene), 2'000'000U);
}

TEST(BenchScenes, SpheresAreSeenWholeAndCoverTheirShare) {
  // The outline is a disc of the radius 523.5/1080 of the height, but for the corners that the
  // polygon cuts off and the pixels on its border: 2π·175 of them, of which less than half differ.
  const double disc = 3.14159265 * 523.5 * 523.5 / (1920.0 * 1080.0);
  const double border = 3.14159265 * 175 / (640.0 * 360.0);
  EXPECT_NEAR(checks::covered_share(make_scene("sphere-20k", 640, 360)), disc, border);
}

// Each of 200 samples is covered by a number of triangles with mean 50 and standard deviation
// √50, so that their mean strays by 5 only at ten times its own standard deviation, ½.
TEST(BenchScenes, SoupHasDepthComplexityFifty) {
  const BenchScene bench = make_scene("soup", 1920, 1080);
  const Camera& camera = bench.camera;
  const Mesh& mesh = bench.scene.meshes[0];
  std::vector<ImagePoint> corners;
  for (const MeshPoint& p : mesh.vertices) {
    corners.push_back({camera.projection.fx * p.x / p.z + camera.projection.cx,
                       camera.projection.fy * p.y / p.z + camera.projection.cy});
  }
  const auto side = [](const ImagePoint& a, const ImagePoint& b, const ImagePoint& s) {
    return (b.u - a.u) * (s.v - a.v) > (b.v - a.v) * (s.u - a.u);
  };
  int covered = 0;
  for (int i = 0; i < 200; ++i) {
    const ImagePoint s{1920.0 * (i % 20 + 0.5) / 20, 1080.0 * (i / 20 + 0.5) / 10};
    for (const auto& [a, b, c] : mesh.triangles) {
      const bool first = side(corners[a], corners[b], s);
      covered += static_cast<int>(first == side(corners[b], corners[c], s) &&
                                  first == side(corners[c], corners[a], s));
    }
  }
  EXPECT_NEAR(covered / 200.0, 50, 5);
}

TEST(BenchScenes, FewLargeTrianglesCoverTheImageAndAreAllSeen) {
  const BenchScene bench = make_scene("few-large", 320, 180);
  const DepthMap map =
      render(bench.scene, bench.camera, {.engine = Engine::fast, .channels = {Channel::id}}).map;
  std::map<std::uint32_t, int> seen;
  for (const std::uint32_t id : *map.values<std::uint32_t>("id")) ++seen[id];
  EXPECT_EQ(seen.count(no_surface), 0U);
  EXPECT_GE(seen.size(), 3U);
}

TEST(BenchScenes, CornersOfTheAlignedGridArePixelCentres) {
  for (const std::uint32_t height : {90U, 1080U, 2160U}) {
    const BenchScene bench = make_scene("grid-aligned", height * 16 / 9, height);
    for (const MeshPoint& p : bench.scene.meshes[0].vertices) {
      ASSERT_EQ(p.x - 0.5, std::floor(p.x));
      ASSERT_EQ(p.y - 0.5, std::floor(p.y));
    }
  }
}

TEST(BenchScenes, RoomIsClosedFromInside) {
  EXPECT_EQ(checks::covered_share(make_scene("room", 320, 180)), 1);
  const double outside = checks::covered_share(make_scene("room-outside", 320, 180));
  EXPECT_GT(outside, 0.1);
  EXPECT_LT(outside, 1);
}

TEST(BenchScenes, AFileThatIsNoSceneIsRefused) {
  EXPECT_FALSE(is_made_scene("sphere-x"));
  EXPECT_FALSE(is_made_scene("sphere-0"));
  EXPECT_FALSE(is_made_scene("sphere-20kk"));
  EXPECT_TRUE(is_made_scene("sphere-2m"));
  EXPECT_FALSE(is_made_scene("city-0"));
  EXPECT_FALSE(is_made_scene("city-2k"));
  EXPECT_TRUE(is_made_scene("city-2"));
  EXPECT_THROW(make_scene("no-such-file.obj", 64, 36), std::exception);
}

}  // namespace
}  // namespace fathom::bench
