// The outlines of triangles in a tile: which pixels they meet, and the number of triangles along
// rows.
#include "fathom/fast/coverage/tile_outlines.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>

#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

/// An orthographic camera that takes (x, y) to column x and row y of an image of 128 by 128 pixels.
Camera flat_camera() {
  Camera camera = checks::camera_of(128, 128, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

struct Outlined {
  Scene scene;
  Camera camera = flat_camera();
  ImageObject object;
  std::vector<std::uint32_t> numbers;
  std::vector<CoverageTriangle> classes;
  TileOutlines outlines;

  Outlined(const std::vector<MeshPoint>& vertices, const std::vector<CornerIndices>& triangles,
           const PixelBox& tile)
      : scene(checks::scene_of(vertices, triangles)),
        object(scene.objects[0], scene.meshes[0], camera, 0),
        numbers(triangles.size()),
        classes(triangles.size()) {
    std::iota(numbers.begin(), numbers.end(), 0U);
    classify_for_coverage(object, numbers, depth_range(camera), tile, classes.data());
    outlines.start(tile);
    outlines.add(object, numbers, classes);
  }
};

std::size_t count_of(const TileRows& rows) {
  std::size_t count = 0;
  for (const std::uint64_t row : rows) count += static_cast<std::size_t>(std::popcount(row));
  return count;
}

/// A square of two triangles in a tile that begins at (64, 64), one of them turned the other way.
TEST(TileOutlines, OfASquareAreItsSides) {
  Outlined square({{70.25, 80.25, 1}, {90.75, 80.25, 1}, {90.75, 100.5, 1}, {70.25, 100.5, 1}},
                  {{0, 1, 2}, {0, 3, 2}}, {64, 127, 64, 127});
  EXPECT_EQ(square.outlines.size(), 4U);
  TileRows met{};
  square.outlines.find_pixels(met);
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      const bool in_square = 6 <= column && column <= 26 && 16 <= row && row <= 36;
      const bool within = 6 < column && column < 26 && 16 < row && row < 36;
      ASSERT_EQ(met[row] >> column & 1, in_square && !within ? 1U : 0U);
    }
  }
  square.outlines.list_edges(met);
  EXPECT_EQ(square.outlines.edges_at(16 * 64 + 6).size(), 2U);
  EXPECT_EQ(square.outlines.edges_at(20 * 64 + 6).size(), 1U);
  EXPECT_EQ(square.outlines.edges_in_row(20), 2U);
  EXPECT_EQ(square.outlines.edges_in_row(40), 0U);
  // One triangle within, none outside.
  EXPECT_EQ(square.outlines.difference(20, {6.75, 20.5}, 0), 1);
  EXPECT_EQ(square.outlines.difference(20, {6.125, 20.5}, 0), 0);
  EXPECT_EQ(square.outlines.difference(20, {26.5, 20.5}, 63), 1);
  EXPECT_EQ(square.outlines.difference(20, {26.875, 20.5}, 0), 0);
  EXPECT_EQ(square.outlines.difference(20, {6.125, 20.5}, 15), -1);
  // On an edge, and at the height of an end.
  EXPECT_EQ(square.outlines.difference(20, {6.25, 20.5}, 0), std::nullopt);
  EXPECT_EQ(square.outlines.difference(36, {10.5, 36.5}, 0), std::nullopt);
}

/// Triangles whose edges meet the tile nowhere, wherever else they are.
TEST(TileOutlines, OfWhatLiesAroundTheTileAreNone) {
  Outlined around({{-500, -500, 1}, {900, -500, 1}, {0, 900, 1}}, {{0, 1, 2}}, {0, 63, 0, 63});
  TileRows met{};
  around.outlines.find_pixels(met);
  EXPECT_EQ(count_of(met), 0U);
  Outlined beside({{64.5, 1, 1}, {90, 1, 1}, {64.5, 40, 1}}, {{0, 1, 2}}, {0, 63, 0, 63});
  EXPECT_EQ(beside.outlines.size(), 0U);
}

/// A mesh whose triangles have vertices of their own, at the same places.
TEST(TileOutlines, VerticesAtOnePlaceAreOne) {
  Outlined square({{10, 10, 1}, {30, 10, 1}, {30, 30, 1}, {10, 10, 1}, {30, 30, 1}, {10, 30, 1}},
                  {{0, 1, 2}, {3, 4, 5}}, {0, 63, 0, 63});
  EXPECT_EQ(square.outlines.size(), 6U);
  TileRows met{};
  square.outlines.find_pixels(met);
  // The diagonal is not met where it is away from the sides.
  EXPECT_EQ(met[20] >> 20 & 1, 0U);
  EXPECT_GT(count_of(met), 70U);
}

/// Numbers along rows against all triangles, one by one.
TEST(TileOutlines, DifferencesAreThoseOfTheTriangles) {
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> place(-10, 74);
  int certain = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> triangles;
    for (std::uint32_t k = 0; k < 8; ++k) {
      for (int corner = 0; corner < 3; ++corner)
        vertices.push_back({place(random), place(random), 1});
      triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    Outlined soup(vertices, triangles, {0, 63, 0, 63});
    TileRows met{};
    soup.outlines.find_pixels(met);
    soup.outlines.list_edges(met);
    const auto number_at = [&](double x, double y) {
      int number = 0;
      for (const CornerIndices& t : triangles) {
        int left = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const MeshPoint &p = vertices[t[k]], &q = vertices[t[(k + 1) % 3]];
          left += (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) > 0 ? 1 : 0;
        }
        number += left % 3 == 0 ? 1 : 0;
      }
      return number;
    };
    for (std::uint32_t row = 0; row < 64; ++row) {
      if (~met[row] == 0) continue;
      const auto column = static_cast<std::uint32_t>(std::countr_zero(~met[row]));
      const SquarePoint point{place(random), row + 0.4142};
      const auto difference = soup.outlines.difference(row, point, column);
      if (!difference || point.x < 0 || point.x > 64) continue;
      ++certain;
      ASSERT_EQ(*difference, number_at(point.x, point.y) - number_at(column + 0.5, point.y)) << row;
    }
  }
  EXPECT_GT(certain, 1500);
}

}  // namespace
}  // namespace fathom
