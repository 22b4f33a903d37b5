#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

#include "fathom/attribution/faults/local_faults.h"

namespace fathom::attribution {
namespace {

std::vector<std::vector<std::size_t>> groups_of(std::string_view image, std::uint32_t width) {
  return pixel_groups(width, static_cast<std::uint32_t>(image.size() / width),
                      [&](std::size_t i) { return image[i] == '#'; });
}

using testing::ElementsAre;
using testing::UnorderedElementsAre;

TEST(PixelGroups, CornersTouchAndBordersDoNot) {
  const auto groups = groups_of(
      "#...."
      ".#..#"
      "#...."
      "...##",
      5);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_THAT(groups[0], UnorderedElementsAre(0, 6, 10));
  EXPECT_THAT(groups[1], ElementsAre(9));  // the last of its row; 10 is the first of the next
  EXPECT_THAT(groups[2], UnorderedElementsAre(18, 19));
}

TEST(PixelGroups, WhatBendsIsOne) {
  const auto groups = groups_of(
      "####"
      "...#"
      "##.#"
      "#..#"
      "####",
      4);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].size(), 14U);
}

TEST(PixelGroups, NoneAndAll) {
  EXPECT_TRUE(groups_of("......", 3).empty());
  ASSERT_EQ(groups_of("######", 3).size(), 1U);
  EXPECT_THAT(groups_of("#", 1), ElementsAre(ElementsAre(0)));
}

}  // namespace
}  // namespace fathom::attribution
