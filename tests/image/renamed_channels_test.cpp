#include "fathom/image/files/renamed_channels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "tests/image/map_samples.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;
using namespace fathom::checks;

std::vector<std::string> names_of(const DepthMap& map) {
  std::vector<std::string> names;
  for (const ImageChannel& channel : map.channels) names.push_back(channel.name);
  return names;
}

DepthMap two_channels() {
  DepthMap map = map_of(2, 1, "Z", std::vector<float>{1, 2});
  map.channels.push_back({"A", std::vector<float>{0.5f, 1}});
  return map;
}

TEST(ChannelNames, AreThoseOfTheFileAndReadBackAsTheirOwn) {
  const Folder folder;
  const DepthMap map = with_channel_names(two_channels(), {{"Z", "Y"}});
  EXPECT_THAT(names_of(map), ElementsAre("Y", "A"));
  write_map(map, folder / "map.exr", MapFormat::exr);
  write_map(map, folder / "map.npz", MapFormat::npz);
  for (const char* name : {"map.exr", "map.npz"}) {
    const DepthMap back = read_map(folder / name);
    ASSERT_NE(back.values<float>("Z"), nullptr) << name;
    EXPECT_THAT(*back.values<float>("Z"), ElementsAre(1, 2)) << name;
    EXPECT_EQ(back.texts.count("fathom.channel-names"), 0u);
  }
}

TEST(ChannelNames, CanChangePlaces) {
  const DepthMap map = with_channel_names(two_channels(), {{"Z", "A"}, {"A", "Z"}});
  EXPECT_THAT(names_of(map), ElementsAre("A", "Z"));
  EXPECT_THAT(names_of(with_own_channel_names(map)), ElementsAre("Z", "A"));
}

TEST(ChannelNames, ThatMeanNothingAreRefused) {
  const DepthMap map = two_channels();
  using Names = std::vector<ChannelName>;
  for (const Names& names :
       {Names{{"id", "Y"}}, Names{{"Z", "A"}}, Names{{"Z", ""}}, Names{{"Z", "a,b"}},
        Names{{"Z", "a=b"}}, Names{{"Z", "Y"}, {"Z", "X"}}, Names{{"Z", "Y"}, {"A", "Y"}}})
    EXPECT_THROW(with_channel_names(map, names), UsageError);
}

TEST(ChannelNames, OfOtherProgramsAreLeftAlone) {
  for (const char* text : {"", "=", "Z", "Z=", "Q=Z,", "Q=Z,R=no", "A=Z", "Z=A,=", "Z=Z=Z"}) {
    DepthMap map = two_channels();
    map.texts["fathom.channel-names"] = text;
    EXPECT_THAT(names_of(with_own_channel_names(map)), ElementsAre("Z", "A")) << text;
  }
}

}  // namespace
}  // namespace fathom
