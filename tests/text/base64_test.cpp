#include "fathom/text/base64.h"

#include <gtest/gtest.h>

#include <string>

namespace fathom::text {
namespace {

/// The bytes as characters; "refused" where there are none.
std::string decoded(std::string_view text) {
  const auto bytes = decode_base64(text);
  if (!bytes) return "refused";
  std::string characters;
  for (const std::byte byte : *bytes) characters.push_back(static_cast<char>(byte));
  return characters;
}

// Section 10 of the source.
TEST(Base64, IsDecodedAsItsSourceSays) {
  EXPECT_EQ(decoded(""), "");
  EXPECT_EQ(decoded("Zg=="), "f");
  EXPECT_EQ(decoded("Zm8="), "fo");
  EXPECT_EQ(decoded("Zm9v"), "foo");
  EXPECT_EQ(decoded("Zm9vYg=="), "foob");
  EXPECT_EQ(decoded("Zm9vYmE="), "fooba");
  EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
}

TEST(Base64, HasEveryDigit) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t k = 0; k < digits.size(); ++k) {
    EXPECT_EQ(decoded(std::string("AAA") + digits[k]), std::string(2, '\0') + static_cast<char>(k));
  }
}

TEST(Base64, NeedsNoPadding) {
  EXPECT_EQ(decoded("Zg"), "f");
  EXPECT_EQ(decoded("Zm8"), "fo");
}

TEST(Base64, RefusesWhatIsNone) {
  for (const char* text : {"!", "A", "AAAAA", "A*==", "Zm9v\n", "Zg==Zg==", "Zg===", "Zm-_"}) {
    EXPECT_EQ(decoded(text), "refused") << text;
  }
}

}  // namespace
}  // namespace fathom::text
