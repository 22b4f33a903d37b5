#include "fathom/text/printable.h"

#include <gtest/gtest.h>

namespace fathom::text {
namespace {

TEST(Printable, ControlCharactersBecomeQuestionMarks) {
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(printable("\x1F\n\t\x7F~ "), "????~ ");
  EXPECT_EQ(printable("é…\x80\xFF"), "é…\xEF\xBF\xBD\xEF\xBF\xBD");
}

}  // namespace
}  // namespace fathom::text
