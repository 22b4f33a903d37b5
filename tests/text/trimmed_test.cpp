#include <gtest/gtest.h>

#include "fathom/text/ascii.h"

namespace fathom::text {
namespace {

TEST(Trimmed, BlanksAroundAFieldGoAndThoseWithinStay) {
  EXPECT_EQ(trimmed("a b"), "a b");
  EXPECT_EQ(trimmed(" \t1.5 2\t\r"), "1.5 2");
  EXPECT_EQ(trimmed("\nx\n"), "\nx\n");
}

TEST(Trimmed, NothingButBlanksIsEmpty) {
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed(" \t\r "), "");
}

}  // namespace
}  // namespace fathom::text
