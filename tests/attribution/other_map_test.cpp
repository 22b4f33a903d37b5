#include "fathom/attribution/other_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom::attribution {
namespace {

constexpr float infinity_32 = std::numeric_limits<float>::infinity();

DepthMap two_pixels() {
  DepthMap map{.width = 2, .height = 1};
  map.channels.push_back({"Z", Samples<float>{1.5F, infinity_32}});
  map.channels.push_back({"id", Samples<std::uint32_t>{7, no_surface}});
  map.channels.push_back({"far.Z", Samples<float>{3, infinity_32}});
  return map;
}

std::string refusal_of(const DepthMap& map, const std::string& channel) {
  try {
    other_map(map, channel);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OtherMaps, AreReadAndWritten) {
  const OtherMap other = other_map(two_pixels());
  EXPECT_EQ(other.width, 2U);
  EXPECT_EQ(other.height, 1U);
  EXPECT_EQ(other.depths, (std::vector<double>{1.5, infinity_32}));
  EXPECT_EQ(other.triangles, (std::vector<std::uint32_t>{7, no_surface}));
  EXPECT_TRUE(other.windows.empty());
  const DepthMap map = as_depth_map(other);
  EXPECT_EQ(*map.values<float>("Z"), *two_pixels().values<float>("Z"));
  EXPECT_EQ(*map.values<std::uint32_t>("id"), *two_pixels().values<std::uint32_t>("id"));
}

TEST(OtherMaps, HoldTheChannelThatIsNamed) {
  EXPECT_EQ(other_map(two_pixels(), "far.Z").depths[0], 3);
  EXPECT_EQ(refusal_of(two_pixels(), "none"), "the map has no channel 'none', only Z, id, far.Z");
  DepthMap without{.width = 1, .height = 1};
  without.channels.push_back({"id", Samples<std::uint32_t>{1}});
  without.channels.push_back({"face", Samples<std::uint32_t>{1}});
  EXPECT_EQ(
      refusal_of(without, ""),
      "of the map's channels id, face none has a name for depths; expected Z, or the name of the "
      "depth channel");
}

TEST(OtherMaps, SayWhatTheirBackgroundIs) {
  DepthMap map{.width = 3, .height = 1};
  map.channels.push_back({"Z", Samples<float>{1.5F, 7, 8}});
  EXPECT_EQ(other_map(map).depths, (std::vector<double>{1.5, 7, 8}));
  map.texts["fathom.background"] = "7";
  EXPECT_EQ(other_map(map).depths, (std::vector<double>{1.5, infinity_32, 8}));
}

TEST(OtherMaps, OfIntegersNeedAScale) {
  DepthMap codes{.width = 2, .height = 1};
  codes.channels.push_back({"Z", Samples<std::uint16_t>{1500, 0}});
  EXPECT_EQ(refusal_of(codes, ""),
            "png_scale: the map holds integers and does not say how many are a unit of depth");
  codes.png_scale = 1000;
  EXPECT_EQ(other_map(codes).depths, (std::vector<double>{1.5, infinity_32}));
}

}  // namespace
}  // namespace fathom::attribution
