#include "fathom/fast/lanes/each_bit.h"

#include <gtest/gtest.h>

#include <vector>

namespace fathom {
namespace {

std::vector<std::size_t> bits_of(std::uint64_t word) {
  std::vector<std::size_t> bits;
  for (const std::size_t k : fast::EachBit(word)) bits.push_back(k);
  return bits;
}

TEST(EachBit, GoesFromTheLowestToTheHighest) {
  EXPECT_TRUE(bits_of(0).empty());
  EXPECT_EQ(bits_of(1), (std::vector<std::size_t>{0}));
  EXPECT_EQ(bits_of(0b10110), (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_EQ(bits_of(0x8000'0001'0000'0001), (std::vector<std::size_t>{0, 32, 63}));
  EXPECT_EQ(bits_of(~std::uint64_t{0}).size(), 64U);
}

}  // namespace
}  // namespace fathom
