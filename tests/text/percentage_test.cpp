#include "fathom/text/percentage.h"

#include <gtest/gtest.h>

namespace fathom::text {
namespace {

TEST(Percentage, OnlyNothingIsNothingAndOnlyAllIsAll) {
  EXPECT_EQ(percentage(0, 7), "0 %");
  EXPECT_EQ(percentage(7, 7), "100 %");
  EXPECT_EQ(percentage(1, 8), "12.5 %");
  EXPECT_EQ(percentage(19566, 19567), "99.995 %");
  EXPECT_EQ(percentage(1, 19567), "0.005 %");
  EXPECT_EQ(percentage(1, 1000), "0.1 %");
  EXPECT_EQ(percentage(999, 1000), "99.9 %");
  EXPECT_EQ(percentage(9996, 10000), "99.96 %");
  constexpr std::uint64_t most = std::uint64_t{1} << 32;
  EXPECT_EQ(percentage(1, most), "0.00000002 %");
  EXPECT_EQ(percentage(most - 1, most), "99.99999998 %");
}

}  // namespace
}  // namespace fathom::text
