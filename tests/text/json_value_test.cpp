#include "fathom/text/json_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace text;
using ::testing::HasSubstr;

/// What a document fails with, read or asked.
template <class Ask>
std::string fault(std::string_view text, const Ask& ask) {
  return message_of<InputError>([&] {
    const JsonDocument document(text, "FILE");
    ask(document.root());
  });
}
std::string fault(std::string_view text) {
  return fault(text, [](const JsonValue&) {});
}

TEST(JsonValue, ValuesAreWhatStandsThere) {
  const JsonDocument document(
      R"({"b": [1, 2.5, -3], "a": {"s": "text", "t": true, "n": null}, "i": 3.0})", "FILE");
  const JsonValue root = document.root();
  EXPECT_EQ(root.at("b").numbers(3), (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(root.at("b").element(1).number(), 2.5);
  EXPECT_EQ(root.at("a").at("s").string(), "text");
  EXPECT_TRUE(root.at("a").at("t").boolean());
  EXPECT_TRUE(root.at("a").at("n").is_null());
  EXPECT_EQ(root.at("i").integer(0, 3), 3U);
  EXPECT_FALSE(root.find("c"));
  ASSERT_EQ(root.members().size(), 3U);
  EXPECT_EQ(root.members()[0].first, "a");
  EXPECT_EQ(root.size(), 3U);
}

TEST(JsonValue, NumbersAreRoundedOnce) {
  const auto number = [](const char* text) { return JsonDocument(text, "FILE").root().number(); };
  EXPECT_EQ(number("0.1"), 0.1);
  // Just above the middle between 1 and the next number; through a wider type it would be a tie.
  EXPECT_EQ(number("1.00000000000000011102230246251565404236316680908203126"), 1 + 0x1p-52);
  EXPECT_EQ(number("1.00000000000000011102230246251565404236316680908203125"), 1);
  EXPECT_EQ(number("18446744073709551615"), 0x1p64);
  EXPECT_THAT(fault("1e999"), HasSubstr("FILE: "));
}

TEST(JsonValue, FaultsNameTheirPlace) {
  const char* text = R"({"list": [1, {"x": "one"}], "n": 1.5})";
  EXPECT_THAT(fault(text,
                    [](const JsonValue& v) {
                      static_cast<void>(v.at("list").element(1).at("x").number());
                    }),
              AllOf(HasSubstr("FILE: list[1].x: "), HasSubstr("expected a number")));
  EXPECT_THAT(fault(text, [](const JsonValue& v) { static_cast<void>(v.at("none")); }),
              HasSubstr("the key \"none\" is missing"));
  EXPECT_THAT(fault(text,
                    [](const JsonValue& v) {
                      v.expect_only({"list", "m"});
                    }),
              HasSubstr("unknown key \"n\""));
  EXPECT_THAT(fault(text, [](const JsonValue& v) { static_cast<void>(v.at("list").elements(3)); }),
              HasSubstr("list: expected a list of 3"));
  EXPECT_THAT(fault(text, [](const JsonValue& v) { static_cast<void>(v.at("n").integer(0, 9)); }),
              HasSubstr("n: expected an integer from 0 to 9"));
  EXPECT_THAT(
      fault("[10]", [](const JsonValue& v) { static_cast<void>(v.element(0).integer(0, 9)); }),
      HasSubstr("[0]: expected an integer"));
  EXPECT_THAT(
      fault("[-1]", [](const JsonValue& v) { static_cast<void>(v.element(0).integer(0, 9)); }),
      HasSubstr("[0]: expected an integer"));
  EXPECT_THAT(fault(text, [](const JsonValue& v) { static_cast<void>(v.at("list").string()); }),
              HasSubstr("list: is a list, expected a string"));
}

TEST(JsonDocument, SyntaxIsStrict) {
  EXPECT_THAT(fault("{\n\n\"a\": }"), HasSubstr("FILE: line 3: "));
  EXPECT_THAT(fault(R"({"a": 1, "a": 2})"), HasSubstr("the key \"a\" stands twice"));
  EXPECT_THAT(fault("[1,]"), HasSubstr("line 1"));
  EXPECT_THAT(fault("NaN"), HasSubstr("line 1"));
  EXPECT_THAT(fault(""), HasSubstr("FILE: "));
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + "1" + std::string(depth, ']');
  };
  EXPECT_THAT(fault(nested(101)), HasSubstr("nested more than 100 deep"));
  EXPECT_TRUE(JsonDocument(nested(100), "FILE").root().is_list());
}

}  // namespace
}  // namespace fathom
