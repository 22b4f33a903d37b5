#include "fathom/text/printable.h"

#include <gtest/gtest.h>

namespace fathom::text {
namespace {

TEST(Printable, ControlCharactersBecomeQuestionMarks) {
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(printable("\x1F\n\t\x7F~ "), "????~ ");
  EXPECT_EQ(printable("é…\x80\xFF"), "é…\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(Printable, WhatHasEffectsBeyondAsciiIsTakenOut) {
  // Controls of ISO 6429, separators, marks and overrides of direction: first and last of each.
  EXPECT_EQ(
      printable("\u0080\u0085\u009f|\u2028\u2029|\u202a\u202e|\u2066\u2069|\u200e\u200f\u061c"),
      "???|??|??|??|???");
  // Their neighbours stay.
  const std::string neighbours =
      "~\u00a0\u2027\u202f\u2065\u206a\u200d\u2010\u061b\u061d\U0010FFFF";
  EXPECT_EQ(printable(neighbours), neighbours);
}

TEST(Printable, WhatIsNotUtf8IsReplacedByteByByte) {
  const std::string r = "\uFFFD";
  EXPECT_EQ(printable("\x9b\xc2"), r + r);  // alone, cut off
  EXPECT_EQ(printable("\xc0\x9b"), r + r);  // longer than need be
  EXPECT_EQ(printable("\xe0\x82\x9b"), r + r + r);
  EXPECT_EQ(printable("\xf0\x80\x82\x9b"), r + r + r + r);
  EXPECT_EQ(printable("\xed\xa0\x80"), r + r + r);          // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), r + r + r + r);  // beyond Unicode
  EXPECT_EQ(printable("\xe2\x80"), r + r);
  EXPECT_EQ(printable("\xc2\xc2"), r + r);
  EXPECT_EQ(printable("\xe2\x80\xe2"), r + r + r);
  EXPECT_EQ(printable("\xf5"
                      "a\xc3"
                      "b"),
            r + "a" + r + "b");
}

TEST(Printable, LinesKeepTheirEnds) {
  EXPECT_EQ(printable_lines("a\tb\r\n\x1b[c\n"), "a\tb?\n?[c\n");
}

TEST(Printable, JsonKeepsItsValue) {
  const std::string text = "{\n \"a\x7f\": \"\u0085é\u202e\"\n}";
  EXPECT_EQ(escaped_json(text), "{\n \"a\\u007f\": \"\\u0085é\\u202e\"\n}");
  EXPECT_EQ(escaped_json("\"\xff\""), "\"\xff\"");
}

}  // namespace
}  // namespace fathom::text
