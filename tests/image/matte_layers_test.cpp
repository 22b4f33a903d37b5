// Cryptomatte as it is shown: names instead of hashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fathom/image/cryptomatte.h"

namespace fathom {
namespace {

using testing::ElementsAre;
using testing::FieldsAre;

/// Three pixels: a cup; a cup before a table; nothing.
DepthMap mapped(const std::vector<std::string>& manifest = {"table", "cup"}) {
  DepthMap map{.width = 3, .height = 1};
  const std::uint32_t cup = cryptomatte_id("cup"), table = cryptomatte_id("table");
  add_mattes(map, {.layer = "CryptoObject",
                   .names = manifest,
                   .counts = {1, 2, 0},
                   .shares = {{cup, 1.0F}, {cup, 0.75F}, {table, 0.25F}}});
  return map;
}

std::vector<std::string> channels(const DepthMap& map) {
  std::vector<std::string> names;
  for (const ImageChannel& channel : map.channels) names.push_back(channel.name);
  return names;
}

TEST(MatteLayers, AreReadBack) {
  const std::vector<MatteLayer> layers = matte_layers(mapped());
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_EQ(layers[0].name, "CryptoObject");
  EXPECT_EQ(layers[0].channels.size(), 12U);  // six ranks
  EXPECT_EQ(layers[0].channels.front(), "CryptoObject00.R");
  EXPECT_EQ(layers[0].channels.back(), "CryptoObject02.A");
  EXPECT_THAT(layers[0].counts, ElementsAre(1, 2, 0));
  EXPECT_EQ(layers[0].names.at(layers[0].shares[2].id), "table");
  EXPECT_EQ(layers[0].shares[2].coverage, 0.25F);
}

TEST(MatteLayers, CountPixelsAndAreasOfNames) {
  EXPECT_THAT(extents(matte_layers(mapped())[0]),
              ElementsAre(FieldsAre("cup", 2U, 1.75), FieldsAre("table", 1U, 0.25)));
}

TEST(MatteLayers, BecomeNumbersOfNamesRankByRank) {
  DepthMap map = with_matte_names(mapped({"table", "cup", "lamp"}));
  EXPECT_THAT(channels(map), ElementsAre("CryptoObject", "CryptoObject.coverage", "CryptoObject.2",
                                         "CryptoObject.2.coverage"));
  EXPECT_THAT(map.tables.at("CryptoObject"), ElementsAre("cup", "lamp", "table"));
  EXPECT_THAT(*map.values<std::uint32_t>("CryptoObject"), ElementsAre(0, 0, no_surface));
  EXPECT_THAT(*map.values<float>("CryptoObject.coverage"), ElementsAre(1, 0.75F, 0));
  EXPECT_THAT(*map.values<std::uint32_t>("CryptoObject.2"), ElementsAre(no_surface, 2, no_surface));
  EXPECT_THAT(*map.values<float>("CryptoObject.2.coverage"), ElementsAre(0, 0.25F, 0));
}

TEST(MatteLayers, IdsWithoutANameAreDigits) {
  DepthMap map = mapped({"cup"});
  EXPECT_THAT(extents(matte_layers(map)[0])[0].name, testing::StartsWith("0x"));
  map.texts["cryptomatte/3ae39a5/manifest"] = "[not a manifest";
  EXPECT_EQ(extents(matte_layers(map)[0]).size(), 2U);
  map.texts["cryptomatte/3ae39a5/manifest"] = R"({"cup": "no id", "table": 3})";
  EXPECT_THAT(extents(matte_layers(map)[0])[0].name, testing::StartsWith("0x"));
}

TEST(MatteLayers, AnIncompleteLayerStaysAsItIs) {
  DepthMap map = mapped();
  map.channels.erase(map.channels.begin() + 1);  // CryptoObject00.G
  const std::vector<std::string> before = channels(map);
  EXPECT_TRUE(matte_layers(map).empty());
  EXPECT_EQ(channels(with_matte_names(map)), before);
}

TEST(MatteLayers, ChannelsKeepTheirNames) {
  DepthMap map = mapped();
  map.channels.push_back({"CryptoObject.2", Samples<float>(3)});
  const std::vector<std::string> before = channels(map);
  EXPECT_EQ(channels(with_matte_names(map)), before);
}

}  // namespace
}  // namespace fathom
