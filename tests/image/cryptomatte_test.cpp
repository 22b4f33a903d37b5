// Hashes of published answers; the channels of a map of two pixels.
#include "fathom/image/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>

namespace fathom {
namespace {

TEST(Cryptomatte, MurmurHashHasItsPublishedValues) {
  EXPECT_EQ(murmur_hash(""), 0U);
  EXPECT_EQ(murmur_hash("test"), 0xba6bd213U);
  EXPECT_EQ(murmur_hash("Hello, world!"), 0xc0363e43U);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

// Names of the manifest that the Cryptomatte specification shows.
TEST(Cryptomatte, IdsAreThoseOfTheSpecification) {
  EXPECT_EQ(cryptomatte_id("bunny"), 0x13851a76U);
  EXPECT_EQ(cryptomatte_id("default"), 0x42c9679fU);
}

TEST(Cryptomatte, IdsAreFiniteNormalNumbers) {
  EXPECT_EQ(cryptomatte_id(""), 0x00800000U);
  int turned = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string name = "object " + std::to_string(i);
    const auto id = std::bit_cast<float>(cryptomatte_id(name));
    ASSERT_TRUE(std::isnormal(id)) << name;
    turned += cryptomatte_id(name) != murmur_hash(name);
  }
  EXPECT_GT(turned, 50);  // 2 of 256 exponents
}

TEST(Cryptomatte, RanksStandInPairsOfChannels) {
  DepthMap map{.width = 2, .height = 1};
  Mattes mattes{"CryptoObject", {"a \"quoted\" name", "b"}, {1, 7}, {}};
  for (std::uint32_t k = 0; k < 8; ++k) mattes.shares.push_back({100 + k, 1 / (1.0F + k)});
  add_mattes(map, mattes);
  EXPECT_EQ(map.channels.size(), 16U);  // seven ranks need four levels
  const auto value = [&](const char* channel, std::size_t pixel) {
    return (*map.values<float>(channel))[pixel];
  };
  EXPECT_EQ(std::bit_cast<std::uint32_t>(value("CryptoObject00.R", 0)), 100U);
  EXPECT_EQ(value("CryptoObject00.G", 0), 1.0F);
  EXPECT_EQ(value("CryptoObject00.B", 0), 0.0F);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(value("CryptoObject03.R", 1)), 107U);
  EXPECT_EQ(value("CryptoObject03.G", 1), 0.125F);
  EXPECT_EQ(value("CryptoObject03.A", 1), 0.0F);
  // The key is made of the first seven digits of the hash of the layer's name, 3ae39a58.
  EXPECT_EQ(map.texts.at("cryptomatte/3ae39a5/name"), "CryptoObject");
  EXPECT_EQ(map.texts.at("cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
}

}  // namespace
}  // namespace fathom
