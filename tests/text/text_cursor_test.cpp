#include "fathom/text/text_cursor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace text;
using ::testing::HasSubstr;

constexpr TextCursor::Syntax plain{}, full{.comments = true, .continuation = true};
const std::string file = "FILE";

/// The words of each line that has some, behind the number of the line they begin on.
std::vector<std::vector<std::string>> words_of(std::string_view text, TextCursor::Syntax syntax) {
  std::vector<std::vector<std::string>> lines;
  TextCursor cursor(text, file, syntax);
  while (cursor.next_line_with_words()) {
    lines.push_back({std::to_string(cursor.line())});
    while (!cursor.at_line_end()) lines.back().emplace_back(cursor.word());
  }
  return lines;
}

using Lines = std::vector<std::vector<std::string>>;

/// What is left of the first line behind its first word.
std::string rest_of(std::string_view text, TextCursor::Syntax syntax) {
  TextCursor cursor(text, file, syntax);
  cursor.word();
  const std::string rest(cursor.rest_of_line());
  EXPECT_EQ(rest, std::string(cursor.rest_of_line()));  // it stays
  return rest;
}

TEST(TextCursor, WhatIsLeftOfALineIsAsItStandsThere) {
  EXPECT_EQ(rest_of("a  b # c \nd", full), "  b # c ");
  EXPECT_EQ(rest_of("a b\r\nd", full), " b\r");
  EXPECT_EQ(rest_of("a b\rd", full), " b");
  EXPECT_EQ(rest_of("a b\\\nc\\\r\nd\ne", full), " b\\\nc\\\r\nd");
  EXPECT_EQ(rest_of("a b\\\nc", plain), " b\\");
  EXPECT_EQ(rest_of("a b #c\\\nd", full), " b #c\\");
  EXPECT_EQ(rest_of("a", full), "");
  EXPECT_EQ(rest_of("a\n", full), "");
  EXPECT_EQ(rest_of("a b\\", full), " b\\");
}

TEST(TextCursor, LinesEndAsTheTextHasIt) {
  const Lines expected{{"1", "a", "b"}, {"3", "c"}};
  EXPECT_EQ(words_of("a b\n\n c", plain), expected);
  EXPECT_EQ(words_of("a\tb\r\n\r\nc\r\n", plain), expected);
  EXPECT_EQ(words_of("a b\r\rc\r", plain), expected);
  EXPECT_EQ(words_of("\xEF\xBB\xBF"
                     "a b\n\nc",
                     plain),
            expected);
  EXPECT_EQ(words_of("", plain), Lines{});
  EXPECT_EQ(words_of("\n \n", plain), Lines{});
}

TEST(TextCursor, CommentsAreNothingWhereThereAreSome) {
  EXPECT_EQ(words_of("a # b\n#c\nd#e", full), (Lines{{"1", "a"}, {"3", "d#e"}}));
  EXPECT_EQ(words_of("a # b\n#c", plain), (Lines{{"1", "a", "#", "b"}, {"2", "#c"}}));
}

TEST(TextCursor, ABackslashJoinsLines) {
  EXPECT_EQ(words_of("a \\\nb\nc", full), (Lines{{"1", "a", "b"}, {"3", "c"}}));
  EXPECT_EQ(words_of("a \\\r\nb\r\nc", full), (Lines{{"1", "a", "b"}, {"3", "c"}}));
  EXPECT_EQ(words_of("a \\\nb", plain), (Lines{{"1", "a", "\\"}, {"2", "b"}}));
  // Elsewhere it joins nothing, and is a part of the text as others are: words go on.
  EXPECT_EQ(words_of("a\\b \\c \\\\d", full), (Lines{{"1", "a", "\\b", "\\c", "\\", "\\d"}}));
  // In a comment it joins nothing.
  TextCursor cursor("a # \\\nb\nc", file, full);
  cursor.skip_line();
  EXPECT_EQ(cursor.word(), "b");
  TextCursor joined("a \\\nb\nc", file, full);
  joined.skip_line();
  EXPECT_EQ(joined.word(), "c");
  EXPECT_EQ(joined.line(), 3U);
}

TEST(TextCursor, NumbersAreWholeWords) {
  TextCursor cursor("0.1 +7 -12 1e-3\n", file, plain);
  EXPECT_EQ(cursor.number<float>("x"), 0.1F);
  EXPECT_EQ(cursor.integer("n"), 7);
  EXPECT_EQ(cursor.integer("n"), -12);
  EXPECT_EQ(cursor.number<double>("x"), 1e-3);
  EXPECT_TRUE(cursor.at_line_end());
}

TEST(TextCursor, AttributesMayBeNoNumber) {
  TextCursor cursor("nan -inf 2", file, plain);
  EXPECT_TRUE(std::isnan(cursor.attribute<double>("normal")));
  EXPECT_EQ(cursor.attribute<double>("normal"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(cursor.attribute<double>("normal"), 2);
}

/// The exponent letter of Fortran's double precision; each is rounded once all the same.
TEST(TextCursor, ExponentsMayHaveTheLetterD) {
  TextCursor cursor("1.5D+01 -2d-2 1D5 0.1D0 1D999 1D 1Dx 1D5x 1D1D1", file, plain);
  EXPECT_EQ(cursor.number<double>("x"), 15);
  EXPECT_EQ(cursor.number<double>("x"), -0.02);
  EXPECT_EQ(cursor.attribute<float>("x"), 100000);
  EXPECT_EQ(cursor.number<double>("x"), 0.1);
  for (const std::string word : {"1D999", "1D", "1Dx", "1D5x", "1D1D1"}) {
    EXPECT_THAT(message_of<InputError>([&] { TextCursor(cursor).number<double>("x"); }),
                HasSubstr("'" + word + "'"));
    cursor.word();
  }
}

TEST(TextCursor, NumbersOfWindowsThatAreNone) {
  TextCursor cursor("1.#IND -1.#IND00 1.#QNAN 1.#snan0 1.#INF -1.#INF00 1.#INFx 1.#", file, plain);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isnan(cursor.attribute<double>("x"))) << i;
  EXPECT_EQ(TextCursor(cursor).attribute<float>("x"), std::numeric_limits<float>::infinity());
  EXPECT_THAT(message_of<InputError>([&] { TextCursor(cursor).number<double>("x"); }),
              HasSubstr("x is not finite, expected a finite number, found '1.#INF'"));
  cursor.word();
  EXPECT_EQ(cursor.attribute<double>("x"), -std::numeric_limits<double>::infinity());
  for (const std::string word : {"1.#INFx", "1.#"}) {
    EXPECT_THAT(message_of<InputError>([&] { TextCursor(cursor).attribute<double>("x"); }),
                HasSubstr("expected x, found '" + word + "'"));
    cursor.word();
  }
}

TEST(TextCursor, FaultsNameFileLineAndWord) {
  const auto fault = [](std::string_view text, auto read) {
    TextCursor cursor(text, file, full);
    cursor.skip_line();
    return message_of<InputError>([&] { read(cursor); });
  };
  const auto number = [](TextCursor& c) { c.number<double>("a coordinate"); };
  const auto integer = [](TextCursor& c) { c.integer("an index"); };
  EXPECT_THAT(fault("\n1x", number), AllOf(HasSubstr("FILE: line 2: "), HasSubstr("'1x'")));
  EXPECT_THAT(fault("\n1e999", number), HasSubstr("'1e999'"));
  EXPECT_THAT(fault("\nnan", number), HasSubstr("'nan'"));
  EXPECT_THAT(fault("\n  # x", number), AllOf(HasSubstr("line 2"), HasSubstr("a coordinate")));
  EXPECT_THAT(fault("\n1.5", integer), AllOf(HasSubstr("an index"), HasSubstr("'1.5'")));
  EXPECT_THAT(fault("\n+-1", integer), HasSubstr("'+-1'"));
  EXPECT_THAT(fault("\n9223372036854775808", integer), HasSubstr("'9223372036854775808'"));
  EXPECT_THAT(fault("\n\x01", integer), HasSubstr("'?'"));
  EXPECT_THAT(fault("\n" + std::string(100, 'x'), integer), HasSubstr(std::string(40, 'x') + "'"));
}

}  // namespace
}  // namespace fathom
