// What threads of the fast engine share: the sorted triangles, the first fault, the output.
#include "fathom/fast/frame.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

TEST(FirstFault, IsThatOfTheFirstPixel) {
  FirstFault first;
  EXPECT_FALSE(first.get());
  first.add(std::nullopt);
  EXPECT_FALSE(first.get());
  const auto fault_at = [](std::size_t pixel) {
    EncodingFault fault{};
    fault.pixel = pixel;
    return fault;
  };
  for (const std::size_t pixel : {40U, 12U, 30U}) first.add(fault_at(pixel));
  ASSERT_TRUE(first.get());
  EXPECT_EQ(first.get()->pixel, 12U);
}

TEST(FastOutput, WholeTilesAreWrittenWhereDepthIsAllThereIs) {
  RenderOptions options;
  EXPECT_TRUE(FastOutput::writes_whole_tiles(options));
  options.channels = {Channel::Z, Channel::A};
  EXPECT_TRUE(FastOutput::writes_whole_tiles(options));
  options.channels = {Channel::Z, Channel::id};
  EXPECT_FALSE(FastOutput::writes_whole_tiles(options));
  options.channels = {Channel::Z};
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  EXPECT_FALSE(FastOutput::writes_whole_tiles(options));
}

/// However many bins there are, each triangle is in the same tiles, once.
TEST(FastFrame, SortingInPartsIsSortingAtOnce) {
  std::mt19937_64 random(211);
  Scene scene = testing::soup(random, 2500, false);
  const Camera camera = testing::camera_of(160, 140, 64);
  const RenderOptions options;
  const FastFrame frame(camera, options);
  const TriangleSource source(scene);
  const SceneRays rays(source, camera);
  ImageObjects objects;
  objects.emplace_back(scene.objects[0], scene.meshes[0], camera, 0);
  const auto sorted = [&](std::uint32_t parts, std::size_t& count) {
    FastWorkers workers([&] { return FastWorker(source, camera, rays); });
    const std::vector<Bins> bins = sort_into_tiles(objects, 0, 2500, parts, frame, workers);
    count = bins.size();
    std::vector<std::multiset<std::uint32_t>> tiles(frame.grid.count());
    for (const Bins& b : bins) {
      for (std::uint32_t tile = 0; tile < frame.grid.count(); ++tile) {
        for (const Side side : {Side::front, Side::back}) {
          for (const TileEntry& e : b.in_tile(tile, side)) tiles[tile].insert(e.number);
        }
      }
    }
    const RenderStatistics statistics = sum_of(workers, 2500);
    EXPECT_EQ(statistics.triangles, 2500U);
    EXPECT_EQ(statistics.facing.interval + statistics.facing.exact, 2500U);
    return tiles;
  };
  std::size_t one = 0, several = 0;
  const auto whole = sorted(1, one), parts = sorted(100, several);
  EXPECT_EQ(one, 1U);
  EXPECT_EQ(several, 3U);  // of 1024 triangles at least
  EXPECT_EQ(whole, parts);
  std::size_t entries = 0;
  for (const auto& tile : whole) {
    entries += tile.size();
    EXPECT_EQ(std::set<std::uint32_t>(tile.begin(), tile.end()).size(), tile.size());
  }
  EXPECT_GT(entries, 2500U);
}

}  // namespace
}  // namespace fathom
