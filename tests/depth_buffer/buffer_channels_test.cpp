#include "fathom/depth_buffer/buffer_channels.h"

#include <gtest/gtest.h>

#include <limits>

#include "fathom/depth_format/encode.h"

namespace fathom {
namespace {

using namespace depth_buffer;

DepthMap map_of(std::uint32_t width) {
  DepthMap map;
  map.width = width;
  map.height = 1;
  map.channels.push_back({"id", Samples<std::uint32_t>(width, no_surface)});
  return map;
}

/// What is stored is read again, in every storage; beside it nothing changes.
TEST(BufferChannels, ValuesOfEveryStorageComeBack) {
  for (const Storage storage : all_storages) {
    const DepthFormat format{Mapping::standard, storage, 1, 10, 1};
    const std::uint64_t greatest = greatest_stored(storage).bits;
    const std::uint64_t values[] = {0,       1, 2, 1023, 1024, 1025, greatest / 3, greatest - 1,
                                    greatest};
    DepthMap map = map_of(static_cast<std::uint32_t>(std::size(values)));
    BufferChannels channels(map, format, false);
    for (std::size_t i = 0; i < std::size(values); ++i) {
      EXPECT_EQ(channels.stored(i), greatest_stored(storage));  // cleared to far
    }
    for (std::size_t i = 0; i < std::size(values); ++i) channels.store(i, {values[i]});
    for (std::size_t i = 0; i < std::size(values); ++i) {
      EXPECT_EQ(channels.stored(i).bits, values[i]) << name_of(storage);
    }
    EXPECT_EQ(channels.id, map.values<std::uint32_t>("id")->data());
  }
}

TEST(BufferChannels, AreNamedByTheirStorage) {
  const auto names = [](Storage storage, bool against_exact) {
    DepthMap map = map_of(2);
    const BufferChannels channels(map, {Mapping::standard, storage, 1, 10, 1}, against_exact);
    EXPECT_EQ(channels.error != nullptr, against_exact);
    std::string all;
    for (const ImageChannel& channel : map.channels) all += channel.name + " ";
    return all;
  };
  EXPECT_EQ(names(Storage::unorm24, false), "id Zwindow Zdecoded ");
  EXPECT_EQ(names(Storage::float16, false), "id Zwindow Zdecoded ");
  EXPECT_EQ(names(Storage::float64, false), "id Zwindow.high Zwindow.low Zdecoded ");
  EXPECT_EQ(names(Storage::unorm16, true), "id Zwindow Zdecoded Zerror Zwinner Zfight ");
}

TEST(BufferChannels, BackgroundIsFarWhicheverWayRound) {
  DepthMap map = map_of(1);
  const BufferChannels reversed(map, {Mapping::reversed, Storage::float32, 1, 10, 1}, true);
  EXPECT_EQ(reversed.stored(0), StoredDepth{});
  EXPECT_EQ(reversed.decoded[0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(reversed.error[0], 0);
  EXPECT_EQ(reversed.winner[0], no_surface);
  EXPECT_EQ(reversed.fight[0], 0U);
  // Floats of 16 bits are shown as the numbers that they are.
  DepthMap half = map_of(1);
  BufferChannels channels(half, {Mapping::standard, Storage::float16, 1, 10, 1}, false);
  channels.store(0, {0x3800});
  EXPECT_EQ(half.values<float>("Zwindow")->at(0), 0.5F);
  channels.store(0, {1});
  EXPECT_EQ(half.values<float>("Zwindow")->at(0), 0x1p-24F);
}

}  // namespace
}  // namespace fathom
