// What threads of the fast engine share: the sorted triangles, the first fault, the output.
#include "fathom/fast/tiles/frame.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "fathom/fast/channels/resolve.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace rendering;
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

void expect_same_bytes(const DepthMap& a, const DepthMap& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    SCOPED_TRACE(a.channels[i].name);
    std::visit(
        [&](const auto& values) {
          const auto& others = std::get<std::decay_t<decltype(values)>>(b.channels[i].values);
          ASSERT_EQ(values.size(), others.size());
          EXPECT_EQ(std::memcmp(values.data(), others.data(), values.size() * sizeof(values[0])),
                    0);
        },
        a.channels[i].values);
  }
}

/// Parts of a map are filled with what make_background() fills all of it with.
TEST(MapBackground, IsThatOfAWholeMapInAnyParts) {
  const Camera camera = checks::camera_of(70, 3, 64);
  RenderOptions options;
  options.channels = {Channel::Z, Channel::A, Channel::id,
                      Channel::P, Channel::N, Channel::distance};
  using Type = DepthEncoding::Type;
  for (const Type type : {Type::binary32, Type::binary64, Type::scaled_unorm16}) {
    options.depth_encoding.type = type;
    const DepthMap expected = make_background(camera, options);
    UnfilledMap unfilled = make_unfilled_map(camera, options);
    for (std::size_t first = 0; first < 210; first += 64) {
      unfilled.background.fill(first, std::min<std::size_t>(64, 210 - first));
    }
    expect_same_bytes(unfilled.map, expected);
    DepthMap used = expected;
    used.values<std::uint32_t>("id")->begin()[100] = 7;
    UnfilledMap again = make_unfilled_map(camera, options, {}, std::move(used));
    MapBackground others = again.background;
    others.leave_out("id");
    others.fill(0, 210);
    EXPECT_EQ(again.map.values<std::uint32_t>("id")->at(100), 7U);
    again.background.fill(64, 64);
    expect_same_bytes(again.map, expected);
  }
}

/// However many bins there are, each triangle is in the same tiles, once.
TEST(FastFrame, SortingInPartsIsSortingAtOnce) {
  std::mt19937_64 random(211);
  Scene scene = checks::soup(random, 2500, false);
  const Camera camera = checks::camera_of(160, 140, 64);
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
