#include "fathom/text/text_ends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace text;
using ::testing::HasSubstr;

std::string zeros(std::size_t count) {
  return std::string(count, '\0');
}

TEST(TextEnds, PaddingBehindTheLastLineIsNoText) {
  EXPECT_EQ(without_padding("a\n" + zeros(1)), "a\n");
  EXPECT_EQ(without_padding("a\r" + zeros(100)), "a\r");
  EXPECT_EQ(without_padding("a\n\x1A"), "a\n");
  EXPECT_EQ(without_padding("a\n\x1A" + zeros(127)), "a\n");
  EXPECT_EQ(without_padding("a\x1A"), "a");
  EXPECT_EQ(without_padding("a" + zeros(1)), "a");
  EXPECT_EQ(without_padding(zeros(3)), "");
  EXPECT_EQ(without_padding(""), "");
}

/// More of them behind a word may stand for what is lost of it.
TEST(TextEnds, ZerosInPlaceOfTextStay) {
  EXPECT_EQ(without_padding("a" + zeros(2)), "a" + zeros(2));
  EXPECT_EQ(without_padding("a" + zeros(2) + "b\n" + zeros(1)), "a" + zeros(2) + "b\n");
}

TEST(TextEnds, Utf16IsRefused) {
  const auto fault = [](std::string_view text) {
    return message_of<InputError>([&] { expect_no_utf16(text, "FILE"); });
  };
  using namespace std::string_view_literals;
  for (const std::string_view text :
       {"\xFF\xFEv\0 \0"sv, "\xFE\xFF\0v\0 "sv, "\xFF\xFE"sv, "v\0 \0"sv, "\0v\0 "sv, "\r\0\n\0"sv})
    EXPECT_EQ(fault(text), "FILE: is text in UTF-16, expected ASCII or UTF-8");
  for (const std::string_view text : {"v 0 0 0"sv, ""sv, "\0"sv, "\0\0\0\0"sv, "v\0"sv, "v\0\0\0"sv,
                                      "\xFE"sv, "\xFF\xFEv 0 "sv, "\xEF\xBB\xBFv 0 "sv, "v\0 0"sv})
    EXPECT_NO_THROW(expect_no_utf16(text, "FILE"));
}

}  // namespace
}  // namespace fathom
