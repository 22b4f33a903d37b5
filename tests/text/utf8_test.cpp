#include <gtest/gtest.h>

#include "fathom/text/printable.h"

namespace fathom::text {
namespace {

TEST(Utf8, StaysAsItIs) {
  for (const char* const text : {"", "plain", "caf\xc3\xa9", "\xe3\x81\xb2", "\xf0\x9f\x90\x84"})
    EXPECT_EQ(as_utf8(text), text);
}

TEST(Utf8, IsMadeOfBytesThatAreNot) {
  EXPECT_EQ(as_utf8("caf\xe9"), "caf\xc3\xa9");
  EXPECT_EQ(as_utf8("\xff\x80"), "\xc3\xbf\xc2\x80");
  // One byte that is wrong makes the whole text one of ISO 8859-1.
  EXPECT_EQ(as_utf8("\xc3\xa9\xe9"), "\xc3\x83\xc2\xa9\xc3\xa9");
  // Cut off, overlong, a surrogate, beyond Unicode.
  for (const char* const text : {"\xe3\x81", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"}) {
    EXPECT_EQ(first_character(text).code, Utf8Character::none);
    EXPECT_EQ(as_utf8(text).size(), 2 * std::string(text).size());
  }
}

}  // namespace
}  // namespace fathom::text
