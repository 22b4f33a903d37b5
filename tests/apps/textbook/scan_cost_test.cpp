// fathom scan: small cases that would cost much.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/small_cost.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

Outcome scan(const std::string& algorithm, const std::string& object,
             std::vector<std::string> options = {}) {
  const TestFolder folder;
  options.insert(options.begin(), {"scan", "--algorithm", algorithm});
  RunOptions run = at_small_cost(folder);
  run.input = object + "\n";
  return run_fathom(options, run);
}

struct Costly {
  const char *algorithm, *object, *said;
};

/// One line each, of numbers that are allowed.
TEST(ScanCost, WhatWouldTakeMinutesIsRefused) {
  const Costly cases[] = {
      {"even-odd", R"({"polygon": [[[0,0],[1e9,0],[3,1e9]]]})", "crossings of edges and rows"},
      {"non-zero", R"({"polygon": [[[0.1,0],[0.2,0],[0.1,1e9]]]})", "crossings of edges and rows"},
      {"scan-line", R"({"triangle": [[0.1,0],[0.2,0],[0.1,1e9]]})", "crossings of edges and rows"},
      {"even-odd",
       R"({"polygon": [[[0,0],[1e9,0],[1e9,9],[0,9]]], "attributes": [[1],[2],[3],[4]]})",
       "more than 4194304 runs"},
      {"edge-function", R"({"triangle": [[0,0],[8e3,0],[0,8e3]]})", "pixels in the triangle's box"},
      {"explicit", R"({"line": [0,0,2e9,7], "width": 2e9, "height": 2})", "steps of the line"},
      {"dda", R"({"line": [0,0,2e9,2e9], "width": 2e9, "height": 1})", "steps of the line"},
      {"bresenham", R"({"line": [0,0,2e9,2e9], "width": 2e9, "height": 1})", "steps of the line"},
      {"midpoint", R"({"line": [0,0,1e9,7]})", "steps of the line"},
      {"diamond-exit", R"({"line": [0,0,2e9,7e8], "width": 2e9, "height": 1})",
       "tests of diamonds"},
  };
  for (const auto& [algorithm, object, said] : cases) {
    const Outcome outcome = scan(algorithm, object, {"--runs"});
    expect_one_line(outcome, 3);
    EXPECT_THAT(outcome.err, HasSubstr(said)) << algorithm;
  }
}

TEST(ScanCost, ManyCornersAreRefusedWhereTheyCostTheirSquare) {
  std::string ring, points;
  for (int k = 0; k < 20'000; ++k) {
    ring += (k == 0 ? "[" : ",[") + std::to_string(k) + "," + std::to_string(k * 7919 % 101) + "]";
    points += (k == 0 ? "[" : ",[") + std::to_string(k) + ",5]";
  }
  const std::string polygon = "{\"polygon\": [[" + ring + "]]";
  expect_one_line(scan("inside", polygon + ", \"points\": [" + points + "]}"), 3);
  expect_one_line(scan("tessellate", polygon + "}"), 3);
  expect_one_line(scan("convexity", polygon + "}"), 3);
  EXPECT_EQ(scan("convex-hull", "{\"points\": [" + ring + "]}").status, 0);
}

/// A star whose sides cross nearly all others.
TEST(ScanCost, ManyCrossingsAreNotTessellated) {
  std::string ring;
  for (int k = 0; k < 1001; ++k) {
    const int x = k * 500 % 1001;
    ring += (k == 0 ? "[" : ",[") + std::to_string(x) + "," + std::to_string(x * (1001 - x)) + "]";
  }
  const Outcome outcome = scan("tessellate", "{\"polygon\": [[" + ring + "]]}");
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("pairs of triangles and edges"));
}

/// Runs are counted, not their pixels.
TEST(ScanCost, LongRunsAreCheap) {
  const Outcome rows =
      scan("even-odd", R"({"polygon": [[[0,0],[2e9,0],[2e9,9],[0,9]]]})", {"--runs"});
  ASSERT_EQ(rows.status, 0) << rows.err;
  EXPECT_EQ(Json::parse(rows.out)["runs"][0], Json::parse("[0,0,2000000000]"));
  const Outcome line = scan("bresenham", R"({"line": [0,0,60e6,1]})", {"--runs"});
  ASSERT_EQ(line.status, 0) << line.err;
  EXPECT_EQ(Json::parse(line.out)["runs"].size(), 2U);
}

/// As many pixels as are written, and one column more.
TEST(ScanCost, AnswersFitIntoMemory) {
  const Outcome most = scan("even-odd", R"({"polygon": [[[0,0],[2048,0],[2048,2048],[0,2048]]]})");
  EXPECT_EQ(most.status, 0) << most.err;
  const Outcome more = scan("even-odd", R"({"polygon": [[[0,0],[2049,0],[2049,2048],[0,2048]]]})");
  expect_one_line(more, 3);
  EXPECT_THAT(more.err, HasSubstr("more than 4194304 pixels"));
  expect_one_line(scan("dda", R"({"line": [0,0,1e6,7]})", {"--trace"}), 3);
  // Of a triangle that covers no centre, the trace has all the rejected ones of its box.
  const std::string thin = R"({"triangle": [[0,0],[800,800],[1e-9,0]]})";
  EXPECT_EQ(scan("edge-function", thin, {"--arithmetic", "float64"}).status, 0);
  expect_one_line(scan("edge-function", thin, {"--arithmetic", "float64", "--trace"}), 3);
}

#ifndef FATHOM_SANITIZED  // --max-memory is not enforced under their shadow memory
TEST(ScanCost, MaxMemoryHolds) {
  const std::string large = R"({"polygon": [[[0,0],[2048,0],[2048,2048],[0,2048]]]})";
  const Outcome outcome = scan("even-odd", large, {"--max-memory", "1M"});
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("--max-memory allows 1.0 MB"));
}
#endif

}  // namespace
}  // namespace fathom::test
