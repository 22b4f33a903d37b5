// fathom clip: small cases that would cost much.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/apps/small_cost.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

Outcome clip(const std::string& algorithm, const std::string& cases,
             std::vector<std::string> options = {}) {
  const TestFolder folder;
  options.insert(options.begin(), {"clip", "--algorithm", algorithm});
  RunOptions run = at_small_cost(folder);
  run.input = cases;
  return run_fathom(options, run);
}

TEST(ClipCost, NestedNamesAreRefused) {
  constexpr std::size_t depth = 100'000;
  const std::string nested = std::string(depth, '[') + std::string(depth, ']');
  for (const char* command : {"clip", "scan"}) {
    const TestFolder folder;
    RunOptions options = at_small_cost(folder);
    options.input = "{\"name\":" + nested + "}\n{\"name\":\"next\"}\n";
    const Outcome outcome = run_fathom(
        {command, "--algorithm", command == std::string("clip") ? "weiler-atherton" : "dda"},
        options);
    expect_one_line(outcome, 3);
    EXPECT_THAT(outcome.err, HasSubstr("line 1: nested more than 100 deep"));
    EXPECT_THAT(outcome.out, HasSubstr("\"name\":\"next\""));
  }
}

#ifndef FATHOM_SANITIZED
// 8 MB for the stack of each thread are allowed on top, so a small case is answered all the same.
TEST(ClipCost, MaxMemoryIsKept) {
  if (std::thread::hardware_concurrency() > 16) GTEST_SKIP() << "the stacks allow what this takes";
  const std::string square = R"("subject":[[[0,0],[4,0],[4,4],[0,4]]],"clip":[]})";
  EXPECT_EQ(clip("weiler-atherton", "{" + square + "\n", {"--max-memory", "1M"}).status, 0);
  std::string long_name = "{\"name\":[0";
  for (int i = 0; i < 10'000'000; ++i) long_name += ",0";
  const Outcome outcome =
      clip("weiler-atherton", long_name + "]," + square + "\n", {"--max-memory", "1M"});
  expect_one_line(outcome, 3);
  EXPECT_EQ(outcome.err,
            "fathom: error: out of memory: the input or the image is too large; --max-memory "
            "allows 1.0 MB\n");
  EXPECT_EQ(outcome.out, "");
}
#endif

TEST(ClipCost, ManyKeysAreRead) {
  std::string keys;
  for (int i = 0; i < 200'000; ++i) keys += ",\"" + std::to_string(i) + "\":0";
  const Outcome outcome = clip("weiler-atherton", "{\"name\":{\"\":0" + keys + "}}\n");
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("\"subject\" is missing"));
}

/// "[[x,y],…]": a square.
std::string square(int x, int y, int side) {
  const auto corner = [](int u, int v) {
    return "[" + std::to_string(u) + "," + std::to_string(v) + "]";
  };
  return "[" + corner(x, y) + "," + corner(x + side, y) + "," + corner(x + side, y + side) + "," +
         corner(x, y + side) + "]";
}

/// Rows of squares that are apart.
std::string squares(int a_side, int offset = 0) {
  std::string rings;
  for (int i = 0; i < a_side * a_side; ++i)
    rings += (rings.empty() ? "[" : ",") +
             square(3 * (i % a_side) + offset, 3 * (i / a_side) + offset, 2);
  return rings + "]";
}

std::string case_of(const std::string& subject, const std::string& clip) {
  return "{\"subject\":" + subject + ",\"clip\":" + clip + "}\n";
}

TEST(ClipCost, ManySquaresAreClipped) {
  const Outcome outcome = clip("weiler-atherton", case_of(squares(50), squares(50, 1)));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["polygons"].size(), 2500U);
}

TEST(ClipCost, ManyHolesGoToTheirOutline) {
  const std::string holes = squares(50);
  const Outcome outcome = clip(
      "weiler-atherton",
      case_of("[" + square(-1, -1, 160) + "," + holes.substr(1), "[" + square(-5, -5, 500) + "]"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["polygons"][0].size(), 2501U);
}

TEST(ClipCost, ManyNestedSquaresAreClipped) {
  const int count = 12'000;
  std::string rings;
  for (int i = 0; i < count; ++i)
    rings += (rings.empty() ? "[" : ",") + square(i, i, 4 * count - 2 * i);
  const Outcome outcome =
      clip("weiler-atherton", case_of(rings + "]", "[[[1.5,1.5],[1e5,0],[0,1e5]]]"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["polygons"].size(), count / 2U);
}

/// The same on a corner: the boxes of all edges meet.
TEST(ClipCost, ManyNestedDiamondsAreClipped) {
  const int count = 6'000;
  std::string rings;
  for (int i = 1; i <= count; ++i) {
    const std::string r = std::to_string(i);
    rings += std::string(rings.empty() ? "[" : ",") + "[[" + r + ",0],[0," + r + "],[-" + r +
             ",0],[0,-" + r + "]]";
  }
  const Outcome outcome = clip(
      "weiler-atherton", case_of(rings + "]", "[[[-1e4,0.5],[1e4,0.5],[1e4,1e4],[-1e4,1e4]]]"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["polygons"].size(), count / 2U);
}

/// Slanted teeth side by side: all their boxes meet.
TEST(ClipCost, ManySlantedTeethAreClipped) {
  std::string ring = "[[";
  const int teeth = 1500;
  for (int k = 0; k < teeth; ++k)
    ring += "[" + std::to_string(2 * k) + ",0],[" + std::to_string(2 * k + 10000) + ",10000],";
  ring += "[30000,10000],[30000,-10],[-10,-10]]]";
  const Outcome outcome = clip("weiler-atherton", case_of(ring, "[" + square(-20, 20, 5000) + "]"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

/// Triangles that have one corner in common.
TEST(ClipCost, ManyRingsMeetInAPoint) {
  std::string rings;
  const int side = 8000;
  for (int k = 0; k < side; ++k)
    rings += std::string(rings.empty() ? "[" : ",") + "[[0,0],[" + std::to_string(side) + "," +
             std::to_string(2 * k) + "],[" + std::to_string(side) + "," +
             std::to_string(2 * k + 1) + "]]";
  const Outcome outcome =
      clip("weiler-atherton", case_of(rings + "]", "[" + square(-1, -1, 4000) + "]"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(Json::parse(outcome.out)["polygons"].size(), 2000U);
}

TEST(ClipCost, TooManyContactsAreRefused) {
  std::string upright, flat;
  for (int k = 0; k < 600; ++k) {
    const std::string u = std::to_string(2 * k), v = std::to_string(2 * k + 1);
    upright += "[" + u + ",0],[" + v + ",5000],";
    flat += "[0," + u + "],[5000," + v + "],";
  }
  const Outcome outcome = clip("weiler-atherton", case_of("[[" + upright + "[1200,-5],[-1,-5]]]",
                                                          "[[" + flat + "[-5,1200],[-5,-1]]]"));
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the rings meet in more than 262144 points"));
}

TEST(ClipCost, ManyCornersAreDecomposed) {
  std::string ring;
  for (int k = 0; k < 1500; ++k)
    ring += "[" + std::to_string(2 * k) + ",0],[" + std::to_string(2 * k + 1) + "," +
            std::to_string(100 + k * 7919 % 13) + "],";
  const Outcome outcome = clip("sutherland-hodgman", "{\"decompose\":true,\"subject\":[[" + ring +
                                                         "[3000,-5],[-1,-5]]],\"clip\":[" +
                                                         square(-10, -10, 50) + "]}\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

/// A regular polygon, counter-clockwise.
std::string circle(int corners) {
  std::string ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners;
    ring += (ring.empty() ? "[[" : ",[") + std::to_string(100 * std::cos(angle)) + "," +
            std::to_string(100 * std::sin(angle)) + "]";
  }
  return ring + "]";
}

TEST(ClipCost, ManyCornersAgainstManyEdgesAreRefused) {
  const auto against_each_other = [](int corners) {
    return "{\"subject\":[" + circle(corners) + "],\"clip\":[" + circle(corners) + "]}\n";
  };
  const Outcome exact = clip("sutherland-hodgman", against_each_other(2100));
  expect_one_line(exact, 3);
  EXPECT_THAT(exact.err, HasSubstr("4410000 tests of a corner against an edge, more than 4194304; "
                                   "--kernel double does more, or clip it in parts"));
  const Outcome doubles =
      clip("sutherland-hodgman", against_each_other(2100), {"--kernel", "double"});
  EXPECT_EQ(doubles.status, 0) << doubles.err;
  const Outcome more = clip("sutherland-hodgman", against_each_other(9000), {"--kernel", "double"});
  expect_one_line(more, 3);
  EXPECT_THAT(more.err, HasSubstr("; clip it in parts"));
}

TEST(ClipCost, ManyCornersAgainstManyPlanesAreRefused) {
  std::string corners, planes;
  for (int k = 0; k < 2100; ++k) {
    corners += (k == 0 ? "[" : ",[") + std::to_string(k) + "," + std::to_string(k * k) + ",0]";
    planes += (k == 0 ? "[1,0,0," : ",[1,0,0,") + std::to_string(-k - 5000) + "]";
  }
  const Outcome outcome =
      clip("sutherland-hodgman", "{\"polygon3\":[" + corners + "],\"planes\":[" + planes + "]}\n");
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("4410000 tests of a corner against a plane"));
}

}  // namespace
}  // namespace fathom::test
