#include <gtest/gtest.h>

#include "fathom/geometry/frames.h"

namespace fathom {
namespace {

TEST(PixelBox, IsEmptyUnlessItSaysMore) {
  EXPECT_TRUE(PixelBox{}.is_empty());
  EXPECT_FALSE(PixelBox{}.contains(0, 0));
  EXPECT_TRUE((PixelBox{3, 3, 5, 4}.is_empty()));
  EXPECT_TRUE((PixelBox{3, 2, 4, 4}.is_empty()));
  EXPECT_FALSE((PixelBox{3, 3, 4, 4}.is_empty()));
}

TEST(PixelBox, HoldsItsFirstAndLastPixels) {
  const PixelBox box{2, 4, 7, 9};
  for (std::uint32_t y = 5; y < 12; ++y) {
    for (std::uint32_t x = 0; x < 7; ++x) {
      EXPECT_EQ(box.contains(x, y), x >= 2 && x <= 4 && y >= 7 && y <= 9) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace fathom
