#include "fathom/text/counted.h"

#include <gtest/gtest.h>

#include <limits>

namespace fathom::text {
namespace {

TEST(Counted, OneIsSingularAndAllElseIsPlural) {
  EXPECT_EQ(counted(0, "pixel"), "0 pixels");
  EXPECT_EQ(counted(1, "pixel"), "1 pixel");
  EXPECT_EQ(counted(2, "pixel"), "2 pixels");
  EXPECT_EQ(counted(std::numeric_limits<std::uint64_t>::max(), "pixel"),
            "18446744073709551615 pixels");
}

TEST(Counted, PluralsThatAreFormedInAnotherWay) {
  EXPECT_EQ(counted(1, "vertex", "vertices"), "1 vertex");
  EXPECT_EQ(counted(3, "vertex", "vertices"), "3 vertices");
}

}  // namespace
}  // namespace fathom::text
