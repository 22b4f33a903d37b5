// What a map may take in memory when it is read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/image/files/map_codecs.h"

namespace fathom::image {
namespace {

/// A constant map of 1000×500 pixels, 2 MB, in some kilobytes.
DepthMap constant_map() {
  DepthMap map;
  map.width = 1000;
  map.height = 500;
  map.channels.push_back({"Z", Samples<float>(500000, 2.0F)});
  return map;
}

files::Bytes exr_of(const DepthMap& map) {
  return encode_exr(map, Compression::zip, 1, "a.exr");
}

files::Bytes png_of(DepthMap map) {
  map.channels[0] = {"Z", Samples<std::uint16_t>(500000, 7)};
  map.png_scale = 1000;
  return encode_png(map, map.channels[0], "a.png");
}

MapMemory allowed(std::uint64_t bytes) {
  return {.allowance = {bytes, "this test allows", ""}, .of_small_file = std::nullopt};
}

MapMemory allowed_small(std::uint64_t bytes) {
  return {.of_small_file = MemoryAllowance{bytes, "a small one may take", "ask for more"}};
}

void expect_refusal(const files::Bytes& bytes, const MapMemory& memory, const std::string& said) {
  try {
    decode_map(bytes, "map", memory);
    FAIL() << "was read, not: " << said;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), said);
  }
}

TEST(MapMemory, NoMoreThanIsAllowed) {
  const files::Bytes exr = exr_of(constant_map());
  EXPECT_NO_THROW(decode_map(exr, "map", allowed(2000000)));
  expect_refusal(exr, allowed(1999999),
                 "map: an image of 1000×500 pixels needs 2.0 MB; this test allows 2.0 MB");
  const files::Bytes png = png_of(constant_map());
  EXPECT_NO_THROW(decode_map(png, "map", allowed(4000000)));
  expect_refusal(png, allowed(3999999),
                 "map: an image of 1000×500 pixels needs 4.0 MB; this test allows 4.0 MB");
}

TEST(MapMemory, EveryChannelCounts) {
  DepthMap map = constant_map();
  map.channels.push_back({"id", Samples<std::uint32_t>(500000, 3)});
  const files::Bytes exr = exr_of(map);
  EXPECT_NO_THROW(decode_map(exr, "map", allowed(4000000)));
  expect_refusal(exr, allowed(3000000),
                 "map: an image of 1000×500 pixels needs 4.0 MB; this test allows 3.0 MB");
}

/// A thousandfold is nothing wrong with a constant map, but is more than its size lets expect.
TEST(MapMemory, SmallFilesHaveALimitOfTheirOwn) {
  const files::Bytes exr = exr_of(constant_map());
  ASSERT_LT(exr.size(), 20000U);
  EXPECT_NO_THROW(decode_map(exr, "map", allowed_small(2000000)));
  expect_refusal(exr, allowed_small(1000000),
                 "map: an image of 1000×500 pixels needs 2.0 MB; a small one may take 1.0 MB; ask "
                 "for more");
  expect_refusal(png_of(constant_map()), allowed_small(1000000),
                 "map: an image of 1000×500 pixels needs 4.0 MB; a small one may take 1.0 MB; ask "
                 "for more");
}

/// What is packed less than a hundredfold is not held to it.
TEST(MapMemory, FilesOfUsualSizeHaveNot) {
  DepthMap map = constant_map();
  const files::Bytes exr = encode_exr(map, Compression::none, 1, "a.exr");
  EXPECT_NO_THROW(decode_map(exr, "map", allowed_small(1)));
}

}  // namespace
}  // namespace fathom::image
