#include "fathom/text/parse_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "tests/places.h"

namespace fathom {
namespace {

using namespace text;
using nlohmann::json;
using nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Json>
JsonFault fault_of(std::string_view text, Json& root) {
  try {
    parse_json(text, root);
  } catch (const JsonFault& fault) {
    return fault;
  }
  ADD_FAILURE() << "no fault in " << text.substr(0, 100);
  return {JsonFault::Kind::syntax, "", 0, {}};
}

template <class Json>
class ParseJson : public ::testing::Test {};
using Kinds = ::testing::Types<json, ordered_json>;
TYPED_TEST_SUITE(ParseJson, Kinds);

TYPED_TEST(ParseJson, ReadsWhatNlohmannReads) {
  for (const char* text :
       {"null", "true", "-3", "18446744073709551615", "0.1", "\"a\\u00e9\"", "[]", "{}",
        R"({"b": [1, [2.5, {}], -3e-2], "a": {"z": null, "s": ["x"], "t": false}, "": [[[]]]})"}) {
    EXPECT_EQ(parse_json<TypeParam>(text), TypeParam::parse(text)) << text;
    EXPECT_EQ(parse_json<TypeParam>(text).dump(), TypeParam::parse(text).dump()) << text;
  }
}

TYPED_TEST(ParseJson, KeepsWhatWasReadBeforeTheFault) {
  TypeParam root;
  const JsonFault fault = fault_of(R"({"name": "n", "list": [1, {"k": x}]})", root);
  EXPECT_EQ(fault.kind(), JsonFault::Kind::syntax);
  EXPECT_EQ(fault.byte(), 33U);
  EXPECT_EQ(root["name"], "n");
  EXPECT_EQ(root["list"].dump(), "[1,{}]");
  ASSERT_EQ(fault.path().size(), 3U);
  EXPECT_EQ(fault.path()[0].key, "list");
  EXPECT_EQ(fault.path()[1].index, 1U);
  EXPECT_EQ(fault.path()[2].key, "k");
}

TYPED_TEST(ParseJson, RefusesWhatNlohmannAccepts) {
  TypeParam root;
  EXPECT_EQ(fault_of(R"({"a": 1, "b": 2, "a": 3})", root).kind(), JsonFault::Kind::key_twice);
  EXPECT_EQ(fault_of("[1, 1e999]", root).kind(), JsonFault::Kind::not_finite);
  EXPECT_EQ(fault_of("[1, 1e999]", root).path()[0].index, 1U);
  EXPECT_EQ(fault_of("[1] 2", root).kind(), JsonFault::Kind::syntax);
  EXPECT_EQ(fault_of("", root).kind(), JsonFault::Kind::syntax);
  EXPECT_EQ(fault_of("\"\xff\"", root).kind(), JsonFault::Kind::syntax);
}

TYPED_TEST(ParseJson, RefusesNulWhereverItStands) {
  using namespace std::string_view_literals;
  const std::pair<std::string_view, std::size_t> texts[] = {
      {"{}\0"sv, 3},     {"[1]\0[2]"sv, 4}, {"{\"a\": 1}\0\0"sv, 9}, {"\0{}"sv, 1},
      {"[1,\0 2]"sv, 4}, {"[12\0]"sv, 4},   {"{\"a\0\": 1}"sv, 4},   {"[tr\0ue]"sv, 4}};
  for (const auto& [text, byte] : texts) {
    TypeParam root;
    const JsonFault fault = fault_of(text, root);
    EXPECT_EQ(fault.kind(), JsonFault::Kind::syntax) << byte;
    EXPECT_EQ(fault.byte(), byte);
    EXPECT_STREQ(fault.what(), "a NUL character");
  }
  // What is wrong before it comes first.
  TypeParam root;
  EXPECT_EQ(fault_of("[1 2]\0"sv, root).byte(), 4U);
  EXPECT_EQ(fault_of("{\"a\":1,\"a\":2}\0"sv, root).kind(), JsonFault::Kind::key_twice);
}

TYPED_TEST(ParseJson, NestsAHundredDeep) {
  const auto lists = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  const auto objects = [](std::size_t depth) {
    std::string text = "0";
    for (; depth > 0; --depth) text = "{\"a\":" + text + "}";
    return text;
  };
  EXPECT_EQ(parse_json<TypeParam>(lists(100)).dump(), lists(100));
  EXPECT_EQ(parse_json<TypeParam>(objects(100)).dump(), objects(100));
  TypeParam root;
  for (const std::string& text :
       {lists(101), objects(101), lists(100'000), std::string(1'000'000, '[')}) {
    const JsonFault fault = fault_of(text, root);
    EXPECT_EQ(fault.kind(), JsonFault::Kind::too_deep);
    EXPECT_THAT(fault.what(), HasSubstr("nested more than 100 deep"));
  }
}

TEST(ParseJson, OrderedObjectsKeepTheirOrder) {
  EXPECT_EQ(parse_json<ordered_json>(R"({"b": 1, "a": {"d": 2, "c": 3}})").dump(),
            R"({"b":1,"a":{"d":2,"c":3}})");
  ordered_json object = ordered_json::object();
  append_member(object, "z", 1);
  append_member(object, "a", "text");
  EXPECT_EQ(object.dump(), R"({"z":1,"a":"text"})");
}

TEST(ParseJson, CborIsHeldToTheSame) {
  const json given{{"a", {1, 2.5, nullptr, "s"}}, {"b", json::binary({1, 2, 3})}};
  std::string bytes;
  json::to_cbor(given, bytes);
  EXPECT_EQ(parse_cbor(bytes), given);
  EXPECT_THROW(parse_cbor(bytes.substr(0, bytes.size() - 1)), JsonFault);
  EXPECT_THROW(parse_cbor(bytes + bytes), JsonFault);
  // A list of one element a byte; nlohmann's reader of CBOR calls itself for each.
  EXPECT_THROW(parse_cbor(std::string(1'000'000, '\x81')), JsonFault);
  EXPECT_THROW(parse_cbor(std::string(1'000'000, '\x9f')), JsonFault);
}

/// Each of the readers of nlohmann, called by its name or by an operator.
TEST(ParseJson, IsTheOneDoor) {
  const std::regex other_door(
      R"([Jj]son(_t)?(<[^>]*>)?::(parse|accept|sax_parse|from_\w+)\(|\bjson_pointer\()");
  int files = 0;
  std::vector<std::string> found;
  for (const char* folder : {"lib", "apps", "validation"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test::source_dir() / folder)) {
      const std::string suffix = entry.path().extension();
      if ((suffix != ".cpp" && suffix != ".h") || entry.path().stem() == "parse_json") continue;
      ++files;
      std::ifstream stream(entry.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (text.find("nlohmann") == std::string::npos && text.find("Json::") == std::string::npos)
        continue;
      for (std::sregex_iterator match(text.begin(), text.end(), other_door), end; match != end;
           ++match)
        found.push_back(entry.path().filename().string() + ": " + match->str());
    }
  }
  EXPECT_GT(files, 500);
  EXPECT_THAT(found, ElementsAre());
}

}  // namespace
}  // namespace fathom
