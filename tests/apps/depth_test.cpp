// fathom depth: the calculator, as users run it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_program.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> with(std::vector<std::string> start,
                              const std::vector<std::string>& more) {
  start.insert(start.end(), more.begin(), more.end());
  return start;
}

Outcome depth(const std::vector<std::string>& arguments, const std::string& input = "") {
  RunOptions options;
  options.input = input;
  return run_fathom(with({"depth"}, arguments), options);
}

const std::vector<std::string> one_to_three{"--mapping", "log", "--storage", "unorm16",
                                            "--near",    "0.5", "--far",     "3"};

TEST(Depth, EncodePrintsCodesOfUnormAndValuesOfFloats) {
  // log 2 / log 4 = 1/2, a tie of unorm16.
  EXPECT_EQ(depth(with(with({"encode"}, one_to_three), {"1", "3"})).out, "32768\n65535\n");
  EXPECT_EQ(depth({"encode", "--mapping", "reversed-infinite", "--near", "0.1", "1"}).out,
            "0.10000000149011612\n");
}

TEST(Depth, ValuesComeFromStandardInputWhereThereAreNone) {
  EXPECT_EQ(depth(with({"encode"}, one_to_three), "1\n 3 \r\n").out, "32768\n65535\n");
  const Outcome bad = depth(with({"encode"}, one_to_three), "1\nx\n3\n");
  EXPECT_EQ(bad.status, 3);
  EXPECT_EQ(bad.out, "32768\n");
  EXPECT_THAT(bad.err, StartsWith("fathom: error: standard input: line 2: "));
}

TEST(Depth, DecodeIsTheInverse) {
  const std::vector<std::string> format{"--storage", "unorm16", "--near", "0.5", "--far", "8"};
  EXPECT_EQ(depth(with(with({"decode"}, format), {"0", "65535"})).out, "0.5\n8\n");
  const Outcome answer =
      depth({"decode", "--mapping", "reversed-infinite", "--near", "1", "--json", "0", "0.25"});
  EXPECT_EQ(answer.out,
            "{\"bits\":0,\"value\":0.0,\"depth\":null}\n"
            "{\"bits\":1048576000,\"value\":0.25,\"depth\":4.0}\n");
}

TEST(Depth, ResolutionAndCodes) {
  // Linear over [1, 65536] in unorm16: a step is one unit everywhere.
  const std::vector<std::string> format{"--mapping", "linear", "--storage", "unorm16",
                                        "--near",    "1",      "--far",     "65536"};
  EXPECT_EQ(depth(with(with({"resolution"}, format), {"1", "1000"})).out, "1\n1\n");
  EXPECT_EQ(depth(with(with({"codes"}, format), {"1", "1000", "11,20", "65536"})).out,
            "1\n1000\n10\n65536\n");
  const auto json =
      nlohmann::json::parse(depth(with(with({"resolution", "--json"}, format), {"10.25"})).out);
  EXPECT_EQ(json["code"], 9);
  EXPECT_EQ(json["to_nearer"], 1);
  EXPECT_EQ(json["separation_behind"], 0.25);
  EXPECT_EQ(json["bin_width"], 1);
}

struct Refusal {
  const char* name;
  std::vector<std::string> arguments;
  int status;
  const char* said;
};

void PrintTo(const Refusal& refusal, std::ostream* stream) {
  *stream << refusal.name;
}

class DepthRefuses : public ::testing::TestWithParam<Refusal> {};

TEST_P(DepthRefuses, InOneLine) {
  const Outcome outcome = depth(GetParam().arguments);
  EXPECT_EQ(outcome.status, GetParam().status);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: "));
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().said));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

INSTANTIATE_TEST_SUITE_P(
    Depth, DepthRefuses,
    ::testing::Values(
        Refusal{"NoQuestion", {}, 2, "--help"},
        Refusal{"NearZero", {"encode", "--near", "0", "--far", "1", "1"}, 2, "near = 0"},
        Refusal{"NearNegative", {"encode", "--near", "-1", "--far", "1", "1"}, 2, "near = -1"},
        Refusal{"NearNan", {"encode", "--near", "nan", "--far", "1", "1"}, 2, "'nan'"},
        Refusal{"NearNotBelowFar", {"encode", "--near", "2", "--far", "2", "2"}, 2, "far = 2"},
        Refusal{"LinearToInfinity",
                {"encode", "--mapping", "linear", "--near", "1", "--far", "inf", "2"},
                2,
                "infinite and reversed-infinite"},
        Refusal{"NoFar", {"encode", "--near", "1", "2"}, 2, "--far"},
        Refusal{"UnknownMapping",
                {"encode", "--mapping", "z", "--near", "1", "--far", "2", "1"},
                2,
                "standard, reversed"},
        Refusal{"UnknownStorage",
                {"encode", "--storage", "unorm8", "--near", "1", "--far", "2", "1"},
                2,
                "unorm16, unorm24"},
        Refusal{"ConstantWithoutLog",
                {"encode", "--near", "1", "--far", "2", "--c", "1", "1"},
                2,
                "only for --mapping log"},
        Refusal{"ConstantZero",
                {"encode", "--mapping", "log", "--near", "1", "--far", "2", "--c", "0", "1"},
                2,
                "--c: 0 is not positive"},
        Refusal{"NoNumber", {"encode", "--near", "1", "--far", "2", "one"}, 2, "'one'"},
        Refusal{"TooNear", {"encode", "--near", "1", "--far", "2", "0.5"}, 3, "nearer than near"},
        Refusal{"TooFar", {"encode", "--near", "1", "--far", "2", "2.5"}, 3, "farther than far"},
        Refusal{"NegativeDepth", {"encode", "--near", "1", "--far", "2", "-3"}, 3, "depth -3"},
        Refusal{"CodeTooGreat",
                {"decode", "--storage", "unorm16", "--near", "1", "--far", "2", "65536"},
                3,
                "0 to 65535"},
        Refusal{"CodeNotWhole",
                {"decode", "--storage", "unorm16", "--near", "1", "--far", "2", "1.5"},
                3,
                "is not a code"},
        Refusal{"ValueAboveOne", {"decode", "--near", "1", "--far", "2", "1.5"}, 3, "from 0 to 1"},
        Refusal{"RangeSwapped", {"codes", "--near", "1", "--far", "2", "2,1"}, 3, "swapped"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Depth, ClampTakesTheNearerEnd) {
  EXPECT_EQ(depth({"encode", "--storage", "unorm16", "--near", "1", "--far", "2", "--clamp", "0.5",
                   "-7", "3"})
                .out,
            "0\n0\n65535\n");
}

Outcome render(const std::vector<std::string>& arguments, const TestFolder& folder) {
  RunOptions options;
  options.folder = folder.path();
  return run_fathom(
      with({"render", source_dir() / "data/meshes/cube.obj", "--size", "32x24"}, arguments),
      options);
}

TEST(Depth, AMapHoldsWhatADepthBufferWould) {
  const TestFolder folder;
  const std::vector<std::string> range{"--near", "0.5", "--far", "64", "-o", "a.exr"};
  const Outcome outcome = render(with(range, {"--depth-format", "unorm16", "--mapping", "log",
                                              "--c", "0.5", "--against-exact", "--stats", "-"}),
                                 folder);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(stats["depth_format"]["mapping"], "log");
  EXPECT_EQ(stats["depth_format"]["fighting_pixels"], 0);

  RunOptions options;
  options.folder = folder.path();
  const auto info = nlohmann::json::parse(run_fathom({"info", "a.exr", "--json"}, options).out);
  std::vector<std::string> names;
  for (const auto& [name, channel] : info["channels"].items()) names.push_back(name);
  EXPECT_THAT(names,
              ::testing::IsSupersetOf({"Z", "Zdecoded", "Zerror", "Zfight", "Zwindow", "Zwinner"}));
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("id")));  // nobody asked for it
}

TEST(Depth, AMapsDepthFormatThatMeansNothingIsRefused) {
  const TestFolder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& said) {
    const Outcome outcome = render(arguments, folder);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  };
  refused({"-o", "a.exr", "--depth-format", "unorm16"}, "near = 0 is not a positive number");
  refused({"-o", "a.exr", "--near", "1", "--depth-format", "unorm16"}, "needs a finite far");
  refused({"-o", "a.exr", "--near", "1", "--far", "9", "--depth-format", "unorm8"}, "unorm24");
  refused({"-o", "a.exr", "--near", "1", "--far", "9", "--depth-format", "unorm16", "--c", "2"},
          "only for --mapping log");
  refused({"-o", "a.exr", "--mapping", "linear"}, "--depth-format");
  refused({"-o", "a.pfm", "--near", "1", "--far", "9", "--depth-format", "unorm16"}, ".exr");
}

}  // namespace
}  // namespace fathom::test
