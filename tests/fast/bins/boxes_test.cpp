// What is certain of a batch of triangles: their boxes hold every sample that they cover.
#include "fathom/fast/bins/boxes.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>

#include "fathom/fast/bins/bins.h"
#include "fathom/scene/element_checks.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;
using checks::CaseMaker;
using checks::Kind;

std::vector<std::uint64_t> in_one_tile(const BoxBatch& boxes) {
  std::vector<std::uint64_t> entries;
  for (const BoxBatch::Entries& side : boxes.in_one_tile) {
    const auto some = side.all();
    entries.insert(entries.end(), some.begin(), some.end());
  }
  return entries;
}

struct Tally {
  int settled = 0, unsettled = 0, degenerate = 0, culled = 0, covered = 0;
};

void check(const checks::Case& c, Cull cull, Tally& tally) {
  const Mesh& mesh = c.scene.meshes[0];
  const VertexTransform transform(c.scene.objects[0], c.camera);
  const auto vertices = std::make_unique<ImageVertex[]>(mesh.vertices.size());
  transform(mesh.vertices, vertices.get());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const TileGrid grid(c.camera.width, c.camera.height);
  const auto boxes = std::make_unique<BoxBatch>();
  box_triangles(
      {vertices.get(), static_cast<std::uint32_t>(mesh.vertices.size()), mesh.triangles.data(),
       count, 100, cull, false, c.camera.width, c.camera.height, grid.columns},
      *boxes);
  const std::set<std::uint32_t> unsettled(
      boxes->unsettled_number.begin(),
      boxes->unsettled_number.begin() + static_cast<std::ptrdiff_t>(boxes->unsettled));
  ASSERT_EQ(unsettled.size(), boxes->unsettled);
  // An image of 6 × 5 pixels is one tile.
  EXPECT_EQ(boxes->in_more_tiles, 0U);
  std::set<std::uint32_t> visible;
  for (const std::uint64_t entry : in_one_tile(*boxes)) {
    EXPECT_EQ(entry >> 32, 0U);
    visible.insert(static_cast<std::uint32_t>(entry));
  }
  tally.unsettled += static_cast<int>(boxes->unsettled);
  tally.settled += static_cast<int>(count - boxes->unsettled);
  std::uint64_t degenerate = 0, culled = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (unsettled.count(100 + i)) continue;
    TierCounts counts;
    const auto t = project(world_corners(c.scene.objects[0], mesh, i), i, c.camera, counts);
    degenerate += t.orientation == Sign::zero;
    if (t.orientation == Sign::zero) continue;
    culled += !is_kept(t, cull);
    if (!is_kept(t, cull)) {
      EXPECT_EQ(visible.count(100 + i), 0U);
      continue;
    }
    for (std::uint32_t pixel = 0; pixel < 30; ++pixel) {
      if (!covers(t, centre_of_pixel(pixel % 6, pixel / 6), counts)) continue;
      ++tally.covered;
      ASSERT_EQ(visible.count(100 + i), 1U);
      break;
    }
  }
  EXPECT_EQ(boxes->degenerate, degenerate);
  EXPECT_EQ(boxes->culled, culled);
  tally.degenerate += static_cast<int>(degenerate);
  tally.culled += static_cast<int>(culled);
}

TEST(Boxes, WhatIsSettledIsSo) {
  Tally tally;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge}) {
    CaseMaker maker(191 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 600 && !HasFatalFailure(); ++i) {
      check(maker.make(), i % 3 == 0 ? Cull::back : i % 3 == 1 ? Cull::front : Cull::none, tally);
    }
  }
  EXPECT_GT(tally.settled, 500);
  EXPECT_GT(tally.unsettled, 500);
  EXPECT_GT(tally.culled, 100);
  EXPECT_GT(tally.degenerate, 20);
  EXPECT_GT(tally.covered, 200);
}

/// Wherever in a batch of whatever size a corner is that indexes no vertex.
TEST(Boxes, CornersThatAreNoVerticesAreFound) {
  const std::vector<MeshPoint> points{{1, 1, 1}, {3, 1, 1}, {1, 3, 1}};
  Camera camera = checks::camera_of(6, 5, 1);
  camera.projection.model = ProjectionModel::orthographic;
  const VertexTransform transform(Object{}, camera);
  std::array<ImageVertex, 3> vertices;
  transform(points, vertices.data());
  const auto boxes = std::make_unique<BoxBatch>();
  for (std::uint32_t count = 1; count < 40; ++count) {
    std::vector<CornerIndices> triangles(count, {0, 1, 2});
    const auto box = [&] {
      box_triangles({vertices.data(), 3, triangles.data(), count, 0, Cull::none, false, 6, 5, 1},
                    *boxes);
    };
    EXPECT_NO_THROW(box());
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
      std::uint32_t& corner = triangles[i / 3][i % 3];
      for (const std::uint32_t wrong : {3U, 0x80000000U, 0xFFFFFFFFU}) {
        const std::uint32_t right = std::exchange(corner, wrong);
        EXPECT_THROW(box(), scene::ElementFault) << i << " of " << count;
        corner = right;
      }
    }
  }
}

/// A batch that is as large as it may be: each triangle where it is on paper.
TEST(Boxes, AFullBatchOnPaper) {
  constexpr std::uint32_t width = 256;
  std::vector<MeshPoint> points;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < BoxBatch::most; ++i) {
    // Corners at multiples of ¼; every eighth reaches over into the next tile to the right.
    const double x = i % 8 == 7 ? 60 + i / 8 % 2 * 64 : 1 + i % 200, y = 2 + i / 200;
    if (i % 8 != 7 && (i % 200) % 64 > 55) {  // would cross as well
      points.insert(points.end(), {{1, y, 1}, {3, y, 1}, {1, y + 2, 1}});
    } else {
      const double side = i % 8 == 7 ? 10 : 2;
      points.insert(points.end(), {{x, y, 1}, {x + side, y, 1}, {x, y + side, 1}});
    }
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Camera camera = checks::camera_of(width, 64, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  const VertexTransform transform(Object{}, camera);
  const auto vertices = std::make_unique<ImageVertex[]>(points.size());
  transform(points, vertices.get());
  const auto boxes = std::make_unique<BoxBatch>();
  box_triangles({vertices.get(), static_cast<std::uint32_t>(points.size()), triangles.data(),
                 BoxBatch::most, 0, Cull::none, false, width, 64, TileGrid(width, 64).columns},
                *boxes);
  EXPECT_EQ(boxes->unsettled, 0U);
  EXPECT_EQ(boxes->in_more_tiles, BoxBatch::most / 8);
  EXPECT_EQ(in_one_tile(*boxes).size(), BoxBatch::most * 7 / 8);
  for (std::size_t k = 0; k < boxes->in_more_tiles; ++k) {
    const std::uint32_t i = boxes->number[k];
    EXPECT_EQ(i % 8, 7U);
    const std::uint32_t x = 60 + i / 8 % 2 * 64, y = 2 + i / 200;
    // Samples at ½ within [x, x + 10) × [y, y + 10), the diagonal's last ones left out.
    EXPECT_EQ(boxes->box[k].first_column, x);
    EXPECT_EQ(boxes->box[k].first_row, y);
    EXPECT_LE(boxes->box[k].last_column, x + 9);
    EXPECT_GE(boxes->box[k].last_column, x + 8);
    EXPECT_LE(boxes->box[k].last_row, y + 9);
  }
  std::map<std::uint32_t, std::uint64_t> tile_of;
  for (const std::uint64_t entry : in_one_tile(*boxes)) {
    tile_of[static_cast<std::uint32_t>(entry)] = entry >> 32;
  }
  for (const auto& [i, tile] : tile_of) {
    EXPECT_EQ(tile, static_cast<std::uint64_t>(points[std::size_t{3} * i].x) / 64) << i;
  }
}

}  // namespace
}  // namespace fathom
