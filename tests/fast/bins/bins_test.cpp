// The tiles of an image, and that the triangles of a tile are all that cover a sample of it, or
// meet it.
#include "fathom/fast/bins/bins.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "fathom/area/coverage.h"
#include "fathom/failures/errors.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/image/depth_map.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/scene_building.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;
using checks::camera_of;

/// What bins of a scene of one mesh are filled from.
struct Filling {
  Filling(const Scene& scene, const Camera& seen_by, std::uint32_t first_number = 0)
      : camera(seen_by),
        triangles(scene),
        rays(triangles, camera),
        referee(triangles, camera, &rays),
        grid(camera.width, camera.height) {
    objects.emplace_back(scene.objects[0], scene.meshes[0], camera, first_number);
  }
  [[nodiscard]] Bins filled(std::uint32_t first, std::uint32_t end, Cull cull, bool by_area) {
    Bins bins(first, end);
    bins.fill({objects, camera, cull, by_area, grid, referee, statistics});
    return bins;
  }
  /// Of all triangles.
  [[nodiscard]] Bins filled(Cull cull = Cull::none, bool by_area = false) {
    return filled(0, static_cast<std::uint32_t>(triangles.count()), cull, by_area);
  }

  const Camera& camera;
  TriangleSource triangles;
  SceneRays rays;
  Referee referee;
  RenderStatistics statistics;
  TileGrid grid;
  ImageObjects objects;
};

std::vector<std::uint32_t> all_in_tile(const Bins& bins, std::uint32_t tile) {
  std::vector<std::uint32_t> numbers;
  for (const Side side : {Side::front, Side::back}) {
    for (const TileEntry& entry : bins.in_tile(tile, side)) numbers.push_back(entry.number);
  }
  return numbers;
}

TEST(TileGrid, TilesAreThePixelsOnce) {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {64U, 64U}, {65U, 128U}, {200U, 150U}}) {
    const TileGrid grid(width, height);
    EXPECT_EQ(grid.count(), grid.columns * grid.rows);
    std::vector<int> times(std::size_t{width} * height);
    for (std::uint32_t tile = 0; tile < grid.count(); ++tile) {
      const PixelBox box = grid.area(tile);
      ASSERT_EQ(box.first_column % TileShape::size, 0U);
      ASSERT_EQ(box.first_row % TileShape::size, 0U);
      for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
        for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
          ++times.at(std::size_t{row} * width + column);
        }
      }
    }
    for (const int count : times) ASSERT_EQ(count, 1);
  }
}

TEST(TileGrid, ReachesToTheLastColumnThatThereIs) {
  constexpr std::uint32_t most = 0xFFFFFFFF;
  for (const std::uint32_t width : {0x80000000U, 0x80000041U, most - 64, most - 1, most}) {
    const TileGrid wide(width, 1), high(1, width);
    ASSERT_EQ(wide.count(), (width - 1) / 64 + 1);
    const std::uint32_t last = wide.count() - 1;
    const PixelBox right = wide.area(last), bottom = high.area(last);
    EXPECT_EQ(right.first_column, last * 64);
    EXPECT_EQ(right.last_column, width - 1);
    EXPECT_EQ(bottom.first_row, last * 64);
    EXPECT_EQ(bottom.last_row, width - 1);
    EXPECT_EQ(right.last_row, 0U);
    EXPECT_EQ(wide.area(last - 1).last_column, last * 64 - 1);
  }
  EXPECT_NO_THROW(TileGrid(most, 64 * 63));
  EXPECT_THROW(TileGrid(most, most), InputError);
}

/// The last numbers that a triangle can have.
TEST(Bins, TakeTheLastTrianglesThatThereAre) {
  const std::uint32_t first = no_surface - 1500;
  std::vector<CornerIndices> triangles(1500, {0, 1, 2});
  const Scene scene = checks::scene_of({{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}, triangles);
  const Camera camera = camera_of(8, 8, 4);
  Filling filling(scene, camera, first);
  const Bins bins = filling.filled(first, no_surface, Cull::none, false);
  const auto found = all_in_tile(bins, 0);
  ASSERT_EQ(found.size(), 1500U);
  for (std::uint32_t i = 0; i < 1500; ++i) ASSERT_EQ(found[i], first + i);
}

/// For areas, tiles get triangles that lie between samples, too, and are told which.
TEST(Bins, SayWhichTrianglesCoverNoSample) {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> place(0, 128), size(-0.8, 0.8);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const double x = i % 16 == 0 ? 64 : place(random), y = place(random);  // some in two tiles
    for (int k = 0; k < 3; ++k) vertices.push_back({x + size(random), y + size(random), 1});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Scene scene = checks::scene_of(vertices, triangles);
  Camera camera = camera_of(128, 128, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  Filling filling(scene, camera);
  const Bins bins = filling.filled(Cull::none, true);
  int without = 0, with = 0, not_told = 0;
  TierCounts counts;
  for (std::uint32_t tile = 0; tile < filling.grid.count(); ++tile) {
    for (const Side side : {Side::front, Side::back}) {
      for (const TileEntry& entry : bins.in_tile(tile, side)) {
        const ProjectedTriangle t =
            project(filling.triangles.world_corners(entry.number), entry.number, camera, counts);
        const PixelBox box = bounding_box(t, camera);
        bool covers_any = false;
        for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
          for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
            covers_any = covers_any || covers(t, centre_of_pixel(column, row), counts);
          }
        }
        const bool told = (entry.nearness & nearness_without_samples) != 0;
        if (covers_any) {
          ASSERT_FALSE(told) << entry.number;
        }
        (covers_any ? with : told ? without : not_told) += 1;
      }
    }
  }
  EXPECT_GT(with, 500);
  EXPECT_GT(without, 1000);
  EXPECT_LT(not_told, without / 5);
}

TEST(ImageObjects, OwnTheNumbersOfTheirTriangles) {
  const Camera camera = camera_of(8, 8, 4);
  Scene scene = checks::scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 1}});
  ImageObjects objects;
  for (std::uint32_t first = 0; first < 10; first += 2) {
    objects.emplace_back(scene.objects[0], scene.meshes[0], camera, first);
  }
  for (std::uint32_t number = 0; number < 10; ++number) {
    EXPECT_EQ(object_of(objects, number).first_number, number / 2 * 2);
  }
  EXPECT_EQ(objects[3].end_number(), 8U);
  EXPECT_EQ(objects[3].vertices[1].u, 8);  // 4·1/1 + 4
}

/// Every triangle is asked for at samples of every tile, exactly, or for the area that it has
/// there.
void check(const Scene& scene, const Camera& camera, Cull cull, bool by_area, int& met) {
  Filling filling(scene, camera);
  const TriangleSource& triangles = filling.triangles;
  const TileGrid& grid = filling.grid;
  const RenderStatistics& statistics = filling.statistics;
  const Bins bins = filling.filled(cull, by_area);
  // Those behind the camera need no decision.
  EXPECT_LE(statistics.facing.interval + statistics.facing.exact, triangles.count());
  for (std::uint32_t tile = 0; tile < grid.count(); ++tile) {
    const auto numbers = all_in_tile(bins, tile);
    const std::set<std::uint32_t> in_tile(numbers.begin(), numbers.end());
    EXPECT_EQ(in_tile.size(), numbers.size());
    const PixelBox area = grid.area(tile);
    for (std::uint32_t number = 0; number < triangles.count(); ++number) {
      TierCounts counts;
      const ProjectedTriangle t = project(triangles.world_corners(number), number, camera, counts);
      if (t.orientation == Sign::zero || !is_kept(t, cull)) {
        EXPECT_EQ(in_tile.count(number), 0U);
        continue;
      }
      const CoverageFrame frame{triangles, camera, cull};
      const auto counts_at = [&](std::uint32_t column, std::uint32_t row) {
        if (by_area) return pixel_coverage(frame, {{number}}, column, row).sign() != Sign::zero;
        const ImagePoint s = centre_of_pixel(column, row);
        return covers(t, s, counts) && depth_at(t, s).sign() == Sign::positive;
      };
      bool meets = false;
      const std::uint32_t step = by_area ? 5 : 1;
      for (std::uint32_t row = area.first_row; row <= area.last_row && !meets; row += step) {
        for (std::uint32_t column = area.first_column; column <= area.last_column && !meets;
             column += step) {
          meets = counts_at(column, row);
        }
      }
      met += meets;
      if (meets) {
        ASSERT_EQ(in_tile.count(number), 1U) << "triangle " << number << ", tile " << tile;
      }
    }
  }
}

TEST(Bins, HoldEveryTriangleThatASampleOrAreaOfTheTileSees) {
  std::mt19937_64 random(181);
  int met = 0;
  for (int i = 0; i < 8 && !HasFatalFailure(); ++i) {
    Camera camera = camera_of(160, 140, 64);
    if (i % 4 == 3) camera.world_to_camera[2][3] = -3.25;  // among the triangles
    const Scene scene = checks::soup(random, 24, i % 2 == 0);
    check(scene, camera, i % 3 == 0 ? Cull::back : Cull::none, i >= 6, met);
  }
  EXPECT_GT(met, 100);
}

/// Of the 100 tiles that its box meets, a long thin triangle across the image meets 19 at most, in
/// front of the camera and reaching behind it.
TEST(Bins, LeaveOutTilesThatLongTrianglesMiss) {
  const Camera camera = camera_of(640, 640, 320);
  for (const double z : {1.0, -1.0}) {
    SCOPED_TRACE(z);
    const Scene scene =
        checks::scene_of({{-1 * z, -0.9 * z, z}, {1, 0.8, 1}, {1, 0.802, 1}}, {{0, 1, 2}});
    Filling filling(scene, camera);
    const Bins bins = filling.filled();
    std::size_t tiles = 0;
    for (std::uint32_t tile = 0; tile < filling.grid.count(); ++tile) {
      tiles += all_in_tile(bins, tile).size();
    }
    EXPECT_GE(tiles, z > 0 ? 10U : 1U);
    EXPECT_LE(tiles, 19U);
    EXPECT_EQ(filling.statistics.facing.exact, 0U);
  }
}

/// A bin of a part of the scene holds that part.
TEST(Bins, HoldTheTrianglesThatTheyAreOf) {
  std::mt19937_64 random(182);
  const Scene scene = checks::soup(random, 30, true);
  const Camera camera = camera_of(160, 140, 64);
  Filling filling(scene, camera);
  const Bins all = filling.filled();
  const Bins first = filling.filled(0, 11, Cull::none, false);
  const Bins rest = filling.filled(11, 30, Cull::none, false);
  for (std::uint32_t tile = 0; tile < filling.grid.count(); ++tile) {
    std::multiset<std::uint32_t> parts;
    for (const Bins* bins : {&first, &rest}) {
      for (const std::uint32_t number : all_in_tile(*bins, tile)) {
        EXPECT_EQ(number < 11, bins == &first);
        parts.insert(number);
      }
    }
    const auto whole = all_in_tile(all, tile);
    EXPECT_EQ(parts, std::multiset<std::uint32_t>(whole.begin(), whole.end()));
  }
}

}  // namespace
}  // namespace fathom
