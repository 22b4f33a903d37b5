#include "fathom/text/json_text.h"

#include <gtest/gtest.h>

namespace fathom::text {
namespace {

TEST(JsonText, StringsAreQuotedAndEscaped) {
  EXPECT_EQ(json_string(""), R"("")");
  EXPECT_EQ(json_string("a \"b\" \\ c\n\x01"), R"("a \"b\" \\ c\n\u0001")");
  EXPECT_EQ(json_string("Öl"), "\"Öl\"");
  EXPECT_EQ(json_string("a\xff"
                        "b\xc3"),
            "\"a\uFFFDb\uFFFD\"");
}

TEST(JsonText, PartsAreJoined) {
  EXPECT_EQ(joined_in('[', {}, ']'), "[]");
  EXPECT_EQ(joined_in('[', {"1"}, ']'), "[1]");
  EXPECT_EQ(joined_in('{', {R"("a":1)", R"("b":2)"}, '}'), R"({"a":1,"b":2})");
}

TEST(JsonText, ListsOfStringsAreRead) {
  using Strings = std::vector<std::string>;
  EXPECT_EQ(strings_of_json(R"( ["a", "", "\u00d6l"] )"), (Strings{"a", "", "Öl"}));
  EXPECT_EQ(strings_of_json("[]"), Strings());
  const std::string names = joined_in('[', {json_string("x\"y"), json_string("\t")}, ']');
  EXPECT_EQ(strings_of_json(names), (Strings{"x\"y", "\t"}));
  for (const char* other : {"", "[", R"(["a", 1])", R"({"a": "b"})", "null", R"(["a"] b)"})
    EXPECT_EQ(strings_of_json(other), std::nullopt) << other;
}

}  // namespace
}  // namespace fathom::text
