// Surfaces without a hole in exact arithmetic have none in the map.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/reference/probe.h"
#include "tests/effort.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::scene_of;

constexpr int side = checks::effort == 1 ? 400 : 60;

// Vertex (i, j) at (u·z, v·z, z), u and v multiples of ½, z of few bits: seen from the origin it
// projects to (u, v) exactly. With fx = 4, neighbours are 2 pixels apart and every vertex and every
// edge's midpoint in the image, the diagonals' too, is a pixel centre.
Scene bumpy_sheet() {
  std::mt19937 random(7);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double z = 4 + static_cast<double>(random() % 64) / 32;
      const double u = (i - side / 2) * 0.5, v = (j - side / 2) * 0.5;
      vertices.push_back({u * z, v * z, z});
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * side + i); };
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return scene_of(std::move(vertices), std::move(triangles));
}

TEST(Watertight, ABumpySheetWithASampleOnEveryVertexAndEdge) {
  const Scene sheet = bumpy_sheet();
  Camera camera = camera_of(2 * side + 1, 2 * side + 1, 4);
  camera.projection.cx = camera.projection.cy =
      side + 1.5;  // vertex (i, j) at pixel (2i + 1, 2j + 1)
  const auto [map, statistics, doubtful] = checks::render_and_count(sheet, camera);
  const Samples<float>& Z = *map.values<float>("Z");
  // The sheet spans the samples 1 … 2·side − 1; those on its right and bottom edges are another's.
  const auto inside = [](int x) { return x >= 1 && x < 2 * side - 1; };
  std::uint64_t expected = 0;
  for (int y = 0; y < 2 * side + 1; ++y) {
    for (int x = 0; x < 2 * side + 1; ++x) {
      const float z = Z[static_cast<std::size_t>(y * (2 * side + 1) + x)];
      const bool is_inside = inside(x) && inside(y);
      expected += is_inside;
      ASSERT_EQ(std::isfinite(z), is_inside) << x << ' ' << y;
      if (is_inside && x % 2 == 1 && y % 2 == 1) {
        const auto vertex = static_cast<std::size_t>((y - 1) / 2 * side + (x - 1) / 2);
        ASSERT_EQ(z, static_cast<float>(sheet.meshes[0].vertices[vertex].z)) << x << ' ' << y;
      }
    }
  }
  EXPECT_EQ(statistics.pixels_with_surface, expected);
  EXPECT_EQ(statistics.samples_covered, expected);  // not one is hit twice
}

// A closed fan around a hub that is exactly on a sample, with rays of all directions, random and
// along the axes and diagonals: each sample inside belongs to exactly one triangle.
TEST(Watertight, AClosedFanCoversEachSampleOnce) {
  std::mt19937 random(8);
  const double direction[][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                 {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (int trial = 0; trial < 300 / checks::effort; ++trial) {
    std::vector<MeshPoint> vertices = {{0, 0, 4}};  // the hub, seen at the centre of pixel (8, 8)
    int skipped = 0;  // at most two directions in a row, so that no triangle spans 180 degrees
    for (const auto& d : direction) {
      if (vertices.size() > 1 && skipped < 2 && random() % 3 == 0) {
        ++skipped;
        continue;
      }
      skipped = 0;
      const double z = 2 + static_cast<double>(random() % 16) / 4;
      const double length = (2 + static_cast<double>(random() % 5)) * z / 8;
      vertices.push_back({d[0] * length, d[1] * length, z});
    }
    std::vector<CornerIndices> triangles;
    const auto rim = static_cast<std::uint32_t>(vertices.size() - 1);
    for (std::uint32_t i = 0; i < rim; ++i) triangles.push_back({0, 1 + i, 1 + (i + 1) % rim});
    const std::size_t first = random() % triangles.size();
    std::rotate(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(first),
                triangles.end());
    const Scene fan = scene_of(vertices, triangles);
    Camera camera = camera_of(17, 17, 8);
    for (std::uint32_t y = 0; y < 17; ++y) {
      for (std::uint32_t x = 0; x < 17; ++x) {
        const auto seen = probe(fan, camera, x, y);
        ASSERT_LE(seen.size(), 1U) << "trial " << trial << " pixel " << x << ' ' << y;
        if (x == 8 && y == 8) {
          ASSERT_EQ(seen.size(), 1U) << "the hub, trial " << trial;
          ASSERT_EQ(seen[0].depth, Ratio(Dyadic(4.0)));
        }
      }
    }
    const RenderStatistics statistics = checks::render_and_count(fan, camera).statistics;
    ASSERT_EQ(statistics.samples_covered, statistics.pixels_with_surface);
    ASSERT_GT(statistics.samples_covered, 0U);
  }
}

}  // namespace
}  // namespace fathom
