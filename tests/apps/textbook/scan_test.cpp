// fathom scan: JSON lines in, JSON lines out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/run_program.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

struct Scanned {
  Outcome outcome;
  std::vector<Json> answers;
};

Scanned scanned_by(const std::string& algorithm, const std::string& cases,
                   std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"scan", "--algorithm", algorithm});
  Scanned result{run_fathom(options, {.input = cases}), {}};
  std::istringstream lines(result.outcome.out);
  for (std::string line; std::getline(lines, line);) result.answers.push_back(Json::parse(line));
  return result;
}

Json answer(const std::string& algorithm, const std::string& object,
            const std::vector<std::string>& options = {}) {
  const Scanned scanned = scanned_by(algorithm, object + "\n", options);
  EXPECT_EQ(scanned.outcome.status, 0) << scanned.outcome.err;
  EXPECT_EQ(scanned.answers.size(), 1u);
  return scanned.answers.empty() ? Json() : scanned.answers[0];
}

/// The line (1, 2) → (5, 4) of an image, y down: y = x/2 + 3/2; 2x − 4y + 6 = 0.
TEST(ScanCommand, GivesTheFormsOfALine) {
  const Json line =
      answer("line-forms", R"({"line": [1,2,5,4], "points": [[3,3],[3,2],[3,4],[9,6],[0,0]],)"
                           R"( "parameters": [0, 0.5, 1, -1]})");
  EXPECT_EQ(line["explicit"], Json::parse(R"({"slope": 0.5, "intercept": 1.5})"));
  EXPECT_EQ(line["implicit"], Json::parse("[2, -4, 6]"));
  const auto column = [&](const char* key) {
    Json list = Json::array();
    for (const Json& point : line["points"]) list.push_back(point[key]);
    return list;
  };
  EXPECT_EQ(column("value"), Json::parse("[0, 4, -4, 0, 6]"));
  EXPECT_EQ(column("side"), Json::parse(R"(["on", "left", "right", "on", "left"])"));
  EXPECT_EQ(column("t"), Json::parse("[0.5, 0.4, 0.6, 2, -0.4]"));
  EXPECT_EQ(line["at"], Json::parse("[[1, 2], [3, 3], [5, 4], [-3, 0]]"));
  const Json upright = answer("line-forms", R"({"line": [2,0,2,7], "points": [[3,1]]})");
  EXPECT_TRUE(upright["explicit"].is_null());
  EXPECT_EQ(upright["implicit"], Json::parse("[7, 0, -14]"));
  EXPECT_EQ(upright["points"][0]["side"], "left");  // on the way down, x = 3 is on the left
}

TEST(Scan, LinesByEveryAlgorithmAndArithmetic) {
  const Json expected = Json::parse("[[0,0],[1,0],[2,1],[3,1],[4,2],[5,2],[6,2],[7,3],[8,3]]");
  for (const std::string algorithm : {"explicit", "dda", "bresenham", "midpoint"}) {
    for (const std::string arithmetic : {"exact", "float64", "float32"}) {
      const Json a =
          answer(algorithm, R"({"name": "n", "line": [0,0,8,3]})", {"--arithmetic", arithmetic});
      EXPECT_EQ(a["pixels"], expected) << algorithm << " " << arithmetic;
      EXPECT_EQ(a["name"], "n");
    }
  }
  EXPECT_EQ(answer("bresenham", R"({"line": [0,0,8,3]})", {"--runs"})["runs"],
            Json::parse("[[0,0,2],[1,2,4],[2,4,7],[3,7,9]]"));
  EXPECT_EQ(answer("bresenham", R"({"line": [8,3,0,0]})", {"--runs"})["runs"],
            Json::parse("[[3,7,9],[2,4,7],[1,2,4],[0,0,2]]"));
}

TEST(Scan, TraceOfTheDecisionVariable) {
  const Json trace = answer("midpoint", R"({"line": [0,0,8,3]})", {"--trace"})["trace"];
  EXPECT_EQ(trace["axis"], "x");
  EXPECT_EQ(trace["steps"][0], Json::parse(R"({"pixel": [0,0], "d": -2, "choice": "E"})"));
  EXPECT_EQ(trace["steps"][1], Json::parse(R"({"pixel": [1,0], "d": 4, "choice": "NE"})"));
  const Json slopes = answer("dda", R"({"line": [0,0,3,1]})", {"--trace", "--exact"})["trace"];
  EXPECT_EQ(slopes["steps"][1]["minor"], "1/3");
}

TEST(Scan, NothingIsChosenAtTheLastPixel) {
  const auto steps = [](const std::string& object) {
    return answer("midpoint", object, {"--trace"})["trace"]["steps"];
  };
  const Json line = steps(R"({"line": [0,0,8,3]})");
  ASSERT_EQ(line.size(), 9u);
  EXPECT_EQ(line[7], Json::parse(R"({"pixel": [7,3], "d": -8, "choice": "E"})"));
  EXPECT_EQ(line[8], Json::parse(R"({"pixel": [8,3], "d": -2})"));
  // A window's last pixel is not the line's.
  const Json cut = steps(R"({"line": [0,0,8,3], "width": 3, "height": 3})");
  ASSERT_EQ(cut.size(), 3u);
  EXPECT_EQ(cut[2], Json::parse(R"({"pixel": [2,1], "d": -6, "choice": "E"})"));
  EXPECT_FALSE(steps(R"({"line": [4,4,4,4]})")[0].contains("choice"));
}

TEST(Scan, VeryLongLinesInAWindow) {
  const Json a = answer(
      "midpoint",
      R"({"line": [-2147483648,-2147483648,2147483648,2147483648], "width": 3, "height": 3})");
  EXPECT_EQ(a["pixels"], Json::parse("[[0,0],[1,1],[2,2]]"));
}

TEST(Scan, TrianglesSnappedAndWithValues) {
  const std::string object =
      R"({"triangle": [[0,0],[4,0],[0,4]], "attributes": [[0],[8],[0]], "width": 9, "height": 9})";
  for (const std::string algorithm : {"edge-function", "scan-line"}) {
    const Json a = answer(algorithm, object);
    EXPECT_EQ(a["pixels"].size(), 6u) << algorithm;  // the slanted edge is a right one
    EXPECT_EQ(a["values"][0], Json::parse("[1.0]"));
    const Json snapped = answer(algorithm, R"({"triangle": [[0.4,0.4],[4.4,0.4],[0.4,4.4]]})",
                                {"--subpixel-bits", "0"});
    EXPECT_EQ(snapped["pixels"], a["pixels"]);
  }
  // 1/w is linear: halfway between w = 1 and w = 3, 1/w = 2/3 and R = (0 + 8/3)/2 / (2/3) = 2.
  const Json w = answer("edge-function",
                        R"({"triangle": [[0,0],[1,1],[1,0]], "attributes": [[0],[8],[4]],)"
                        R"( "w": [1,3,1.5]})",
                        {"--exact"});
  EXPECT_EQ(w["values"][0][0], "2");
}

TEST(Scan, PolygonsFloodAndQuestions) {
  const std::string l = R"({"polygon": [[[0,0],[4,0],[4,2],[2,2],[2,4],[0,4]]]})";
  EXPECT_EQ(answer("even-odd", l, {"--runs"})["runs"],
            Json::parse("[[0,0,4],[1,0,4],[2,0,2],[3,0,2]]"));
  EXPECT_EQ(answer("non-zero", l)["pixels"].size(), 12u);
  EXPECT_EQ(answer("convexity", l)["convex"], false);
  EXPECT_EQ(answer("tessellate", l)["triangles"].size(), 4u);
  EXPECT_EQ(answer("convex-hull", R"({"points": [[0,0],[2,1],[4,0],[0,4]]})")["hull"].size(), 3u);
  const Json inside = answer(
      "inside", R"({"polygon": [[[0,0],[4,0],[4,2],[2,2],[2,4],[0,4]]], "points": [[1,3],[3,3]]})");
  EXPECT_EQ(inside["inside"], Json::parse("[true, false]"));
  EXPECT_EQ(inside["on_one_side_of_every_edge"], Json::parse("[false, false]"));
  const std::string grid = R"({"grid": ["#..", ".#.", "..#"], "seed": [0,0], "connectivity": )";
  EXPECT_EQ(answer("flood", grid + "4}")["pixels"], Json::parse("[[0,0]]"));
  EXPECT_EQ(answer("flood", grid + "8}")["pixels"], Json::parse("[[0,0],[1,1],[2,2]]"));
  const Json trace = answer("even-odd", l, {"--trace"})["trace"];
  EXPECT_EQ(trace[0]["crossings"].size(), 2u);
}

TEST(Scan, DiamondExitTakesAnyEnds) {
  EXPECT_EQ(answer("diamond-exit", R"({"line": [0.5,0.5,3.5,0.5]})")["pixels"],
            Json::parse("[[0,0],[1,0],[2,0]]"));
  // Whole numbers are corners of pixels here, and centres for the other lines.
  EXPECT_EQ(answer("diamond-exit", R"({"line": [0,0,8,3]})")["pixels"],
            Json::parse("[[0,0],[1,0],[2,0],[3,1],[4,1],[5,2],[6,2],[7,2]]"));
  const Json trace =
      answer("diamond-exit", R"({"line": [0.5,0.5,0.5,2.5]})", {"--trace", "--exact"})["trace"];
  EXPECT_EQ(trace, Json::parse(R"({"axis": "y", "steps": [
      {"pixel": [0,0], "enters": "0", "leaves": "1/4"},
      {"pixel": [0,1], "enters": "1/4", "leaves": "3/4"}]})"));
}

/// Counter-clockwise on the screen, y down, is positive, whatever is asked.
TEST(Scan, TheSamePolygonHasTheSameSignEverywhere) {
  const struct {
    const char *corners, *point, *triangle;
    int orientation;
  } cases[] = {
      {"[0,0],[4,0],[4,4],[0,4]", "[1,1]", "[0,0],[4,0],[4,4]", -1},
      {"[0,4],[4,4],[4,0],[0,0]", "[1,1]", "[4,4],[4,0],[0,0]", 1},
      {"[8,0],[13,15],[0,6],[16,6],[3,15]", "[8,8]", "[8,0],[13,15],[0,6]", -2},
      {"[3,15],[16,6],[0,6],[13,15],[8,0]", "[8,8]", "[0,6],[13,15],[8,0]", 2},
  };
  for (const auto& [corners, point, triangle, orientation] : cases) {
    const std::string polygon = "{\"polygon\": [[" + std::string(corners) + "]]";
    const Json convexity = answer("convexity", polygon + "}");
    EXPECT_EQ(convexity["turning_number"], orientation) << corners;
    EXPECT_EQ(convexity["turns"][0], orientation > 0 ? 1 : -1) << corners;
    const Json inside = answer("inside", polygon + ", \"points\": [" + point + "]}");
    EXPECT_EQ(inside["winding"], Json::array({orientation})) << corners;
    EXPECT_EQ(inside["on_one_side_of_every_edge"], Json::parse("[true]")) << corners;
    const Json lines = answer("non-zero", polygon + "}", {"--trace"})["trace"];
    EXPECT_EQ(lines[0]["crossings"][0]["winding"], orientation > 0 ? 1 : -1) << corners;
    const Json edges = answer("edge-function", "{\"triangle\": [" + std::string(triangle) + "]}",
                              {"--trace"})["trace"];
    EXPECT_EQ(edges["winding"], orientation > 0 ? "counter-clockwise" : "clockwise") << corners;
  }
  // Hulls and pieces run counter-clockwise: each is a polygon of +1.
  const Json hull = answer("convex-hull", R"({"points": [[0,0],[2,1],[4,0],[0,4]]})")["hull"];
  EXPECT_EQ(answer("convexity", Json{{"polygon", {hull}}}.dump())["turning_number"], 1);
  const Json pieces =
      answer("tessellate", R"({"polygon": [[[0,0],[4,0],[4,2],[2,2],[2,4],[0,4]]]})");
  for (const Json& piece : pieces["triangles"])
    EXPECT_EQ(answer("convexity", Json{{"polygon", {piece}}}.dump())["turning_number"], 1);
}

TEST(Scan, CombinationsLieInTheHullUnlessAWeightIsNegative) {
  const auto combined = [](const std::string& weights) {
    return answer("convex-hull",
                  R"({"points": [[0,0],[4,0],[0,4],[1,1]], "weights": )" + weights + "}",
                  {"--exact"});
  };
  const Json within = combined("[1,1,2,0]");
  EXPECT_EQ(within["hull"].size(), 3u);
  EXPECT_EQ(within["combination"], Json::parse(R"(["1", "2"])"));
  EXPECT_EQ(within["inside"], true);
  const Json thirds = combined("[1,1,1,0]");
  EXPECT_EQ(thirds["combination"], Json::parse(R"(["4/3", "4/3"])"));
  EXPECT_EQ(thirds["inside"], true);
  EXPECT_EQ(combined("[0,1,1,0]")["inside"], true);  // on the border
  EXPECT_EQ(combined("[-1,1,1,0]")["inside"], false);
  EXPECT_EQ(combined("[-1e-300,1,1,0]")["inside"], false);
  EXPECT_EQ(combined("[-1,0,0,9]")["inside"], true);  // negative weights need not leave it
  EXPECT_FALSE(answer("convex-hull", R"({"points": [[0,0]]})").contains("combination"));
}

TEST(Scan, TracesOfEdgeFunctionsShowTheBoxAndWhatIsRejected) {
  const Json trace =
      answer("edge-function", R"({"triangle": [[0,0],[3,0],[0,2]]})", {"--trace"})["trace"];
  EXPECT_EQ(trace["box"], Json::parse(R"({"x_begin": 0, "x_end": 3, "y_begin": 0, "y_end": 2})"));
  EXPECT_EQ(trace["samples"].size() + trace["rejected"].size(), 6u);
  EXPECT_EQ(trace["rejected"][0], Json::parse(R"({"pixel": [2,0], "signs": [-1,1,1]})"));
  // Centres on a right edge: 0, and not covered.
  const Json on_edge = answer("edge-function", R"({"triangle": [[0,0],[2,0],[0,2]]})",
                              {"--trace"})["trace"]["rejected"];
  EXPECT_EQ(on_edge[0], Json::parse(R"({"pixel": [1,0], "signs": [0,1,1]})"));
  const Json window =
      answer("edge-function", R"({"triangle": [[-2,-2],[3,0],[0,2]], "width": 2, "height": 9})",
             {"--trace"})["trace"];
  EXPECT_EQ(window["box"], Json::parse(R"({"x_begin": 0, "x_end": 2, "y_begin": 0, "y_end": 2})"));
  const Json flat =
      answer("edge-function", R"({"triangle": [[0,0],[1,1],[2,2]]})", {"--trace"})["trace"];
  EXPECT_EQ(flat["degenerate"], true);
  EXPECT_FALSE(flat.contains("rejected"));
}

/// The value at the middle of a square depends on how it is turned.
TEST(Scan, TwoStepInterpolationOfQuadrilateralsDependsOnRotation) {
  const auto at_3_3 = [](const std::string& corners) {
    const Json a =
        answer("even-odd", "{\"polygon\": [[" + corners + "]], \"attributes\": [[0],[1],[0],[0]]}",
               {"--exact"});
    for (std::size_t i = 0; i < a["pixels"].size(); ++i)
      if (a["pixels"][i] == Json::parse("[3,3]")) return a["values"][i][0];
    return Json();
  };
  EXPECT_EQ(at_3_3("[0,0],[7,0],[7,7],[0,7]"), "1/4");
  EXPECT_EQ(at_3_3("[3.5,0],[7,3.5],[3.5,7],[0,3.5]"), "1/2");
}

// To a reader of JSON it is the end of the text.
TEST(Scan, WhatComesAfterANulIsRefused) {
  using namespace std::string_literals;
  const Scanned scanned = scanned_by("dda", "{\"line\": [0,0,1,1]}\0 {\"line\": [5,5,6,6]}\n"s);
  EXPECT_EQ(scanned.outcome.status, 3);
  EXPECT_EQ(scanned.answers.at(0), Json({{"error", "not JSON at character 20"}}));
}

TEST(Scan, TheTextbooksPixelsCanBeFoundAgain) {
  const std::string line = R"({"line": [0,0,8,3]})";
  EXPECT_EQ(answer("bresenham", line, {"--ties", "stay"})["pixels"],
            Json::parse("[[0,0],[1,0],[2,1],[3,1],[4,1],[5,2],[6,2],[7,3],[8,3]]"));
  EXPECT_EQ(answer("bresenham", line, {"--ties", "greater"}), answer("bresenham", line));
  EXPECT_EQ(answer("dda", R"({"line": [0,0,4,2]})",
                   {"--arithmetic", "float64", "--ties", "even"})["pixels"],
            Json::parse("[[0,0],[1,0],[2,1],[3,2],[4,2]]"));
  const Json trace = answer("midpoint", line, {"--ties", "stay", "--trace"})["trace"]["steps"];
  EXPECT_EQ(trace[3]["d"], 0);
  EXPECT_EQ(trace[3]["choice"], "E");
  // Of a square's two halves both have the centres on the diagonal.
  const std::string half = R"({"triangle": [[0,0],[4,4],[4,0]]})";
  EXPECT_EQ(answer("edge-function", half)["pixels"].size(), 10u);
  const std::string other = R"({"triangle": [[0,0],[0,4],[4,4]]})";
  EXPECT_EQ(answer("edge-function", other)["pixels"].size(), 6u);
  EXPECT_EQ(answer("edge-function", other, {"--edges", "closed"})["pixels"].size(), 10u);
  EXPECT_EQ(
      answer("edge-function", other, {"--edges", "closed", "--trace"})["trace"]["rejected"].size(),
      6u);
}

TEST(Scan, TheTextbooksRulesAreRefusedWhereTheyMeanNothing) {
  const auto refused = [](const std::string& algorithm, const std::vector<std::string>& options,
                          const std::string& said) {
    const Scanned scanned = scanned_by(algorithm, "{}\n", options);
    EXPECT_EQ(scanned.outcome.status, 2);
    EXPECT_THAT(scanned.outcome.err, HasSubstr(said));
  };
  refused("even-odd", {"--ties", "stay"},
          "--ties is for lines: explicit, dda, bresenham and midpoint");
  refused("diamond-exit", {"--ties", "even"}, "--ties is for lines");
  refused("scan-line", {"--edges", "closed"}, "--edges is for edge-function");
  refused("dda", {"--ties", "up"}, "greater");
}

// A ring may repeat its first corner, as for `fathom clip`: the answer is the same.
TEST(Scan, RingsMayBeClosed) {
  const std::string open = R"([[1,1],[8,2],[4,7]])", closed = R"([[1,1],[8,2],[4,7],[1,1]])";
  const std::string hole = R"([[3,3],[5,3],[4,5]])", closed_hole = R"([[3,3],[5,3],[4,5],[3,3]])";
  const struct {
    const char *algorithm, *more;
  } questions[] = {{"even-odd", ""},
                   {"non-zero", R"(, "width": 9, "height": 4)"},
                   {"inside", R"(, "points": [[4,4],[7,3],[1,1],[0,0]])"},
                   {"tessellate", ""}};
  for (const auto& [algorithm, more] : questions) {
    const auto of = [&](const std::string& outline, const std::string& inner) {
      return answer(algorithm, "{\"polygon\": [" + outline + "," + inner + "]" + more + "}");
    };
    EXPECT_EQ(of(closed, closed_hole), of(open, hole)) << algorithm;
    EXPECT_EQ(of(closed, hole), of(open, hole)) << algorithm;
  }
  EXPECT_EQ(answer("convexity", "{\"polygon\": [" + closed + "]}"),
            answer("convexity", "{\"polygon\": [" + open + "]}"));
  // Every corner that is written has its numbers.
  EXPECT_EQ(
      answer("even-odd", "{\"polygon\": [" + closed + "," + closed_hole +
                             "], "
                             R"("attributes": [[1],[2],[3],[1],[4],[5],[6],[4]],)"
                             R"( "w": [1,2,1,1,3,3,1,3]})"),
      answer("even-odd", "{\"polygon\": [" + open + "," + hole +
                             "], "
                             R"("attributes": [[1],[2],[3],[4],[5],[6]], "w": [1,2,1,3,3,1]})"));
}

TEST(Scan, CasesThatCannotBeDoneDoNotStopTheOthers) {
  const struct {
    const char *algorithm, *object, *said;
  } cases[] = {
      {"bresenham", R"({"line": [0,0,1.5,3]})", "1.5 is not a whole number"},
      {"bresenham", R"({"line": [0,0,1]})", "3 numbers where 4 are expected"},
      {"dda", R"({"line": [0,0,4294967296,3]})", "beyond 2^31"},
      {"dda", R"({"line": [0,NaN,1,3]})", "not finite"},
      {"dda", R"({"line": [0,0,2147483648,3]})", "2147483649 steps of the line, more than 4194304"},
      {"midpoint", R"({"line": [0,0,1,1], "width": 0, "height": 5})", "expected a whole number"},
      {"midpoint", R"({"line": [0,0,1,1], "width": 5})", "\"height\" is missing"},
      {"midpoint", R"({"lime": [0,0,1,1]})", "is not a key"},
      {"edge-function", R"({"triangle": [[0,0],[1,1]]})", "2 corners; expected 3"},
      {"edge-function", R"({"triangle": [[0,0],[1,1],[0,1]], "attributes": [[1]]})",
       "attributes: 1 list for 3 corners"},
      {"edge-function", R"({"triangle": [[0,0],[1,1],[0,1]], "attributes": [[1,2],[3],[4,5]]})",
       "attributes[1]: 1 number, but 2 at the first corner"},
      {"even-odd", R"({"polygon": [[[0,0]]]})", "ring 0 has 1 corner; expected at least 3"},
      {"edge-function", R"({"triangle": [[0,0],[1e9,1],[0,1e9]]})", "limit it"},
      {"edge-function",
       R"({"triangle": [[0,0],[9,1],[2,8]], "attributes": [[1],[2],[3]], "w": [1,0,1]})",
       "w[1] is 0"},
      {"even-odd", R"({"polygon": [[[0,0],[1,1]]]})", "expected at least 3"},
      {"even-odd", R"({"polygon": []})", "expected at least one ring"},
      {"inside", R"({"polygon": [[[0,0],[4,0],[0,0]]], "points": []})",
       "ring 0 has 2 corners; expected at least 3"},
      {"even-odd", R"({"polygon": [[[0,0],[4,0],[0,4],[0,0]]], "attributes": [[1],[2],[3]]})",
       "attributes: 3 lists for 4 corners"},
      {"even-odd", R"({"polygon": [[[0,0],[4,0],[0,4],[0,0]]], "attributes": [[1],[2],[3],[4]]})",
       "attributes[3] differs from attributes[0], but both are of one corner: it closes the ring"},
      {"inside", R"({"polygon": [[[0,0],[4,0],[0,4]]], "points": [], "width": -5, "height": 3})",
       "\"width\" is -5; expected a whole number"},
      {"convexity", R"({"polygon": [[[0,0],[4,0],[0,4]]], "width": 3})", "\"height\" is missing"},
      {"tessellate", R"({"polygon": [[[0,0],[4,0],[0,4]]], "height": 3})", "\"width\" is missing"},
      {"convex-hull", R"({"points": [[0,0]], "width": "abc", "height": 3})", "expected a number"},
      {"line-forms", R"({"line": [0,0,1e308,1e308], "points": [[1e308,-1e308]]})",
       "a result is too large; exact arithmetic with --exact writes any number"},
      {"flood", R"({"grid": ["ab","c"], "seed": [0,0]})", "has 1 character, the first row 2"},
      {"flood", R"({"grid": ["ab"], "seed": [2,0]})", "not a pixel of the grid"},
      {"flood", R"({"grid": ["ab"], "seed": [0,0], "connectivity": 6})", "expected 4 or 8"},
      {"convex-hull", R"({"points": []})", "expected at least one"},
      {"convex-hull", R"({"points": [[0,0],[1,1]], "weights": [1]})", "1 number where 2 are"},
      {"convex-hull", R"({"points": [[0,0],[1,1]], "weights": [-1,1]})", "expected a sum above 0"},
      {"line-forms", R"({"line": [1,2,1,2]})", "its ends are the same"},
  };
  for (const auto& [algorithm, object, said] : cases) {
    const Scanned scanned = scanned_by(algorithm, std::string(object) + "\n");
    EXPECT_EQ(scanned.outcome.status, 3) << object;
    ASSERT_EQ(scanned.answers.size(), 1u) << object;
    EXPECT_THAT(scanned.answers[0].value("error", ""), HasSubstr(said)) << object;
    EXPECT_THAT(scanned.outcome.err, HasSubstr("standard input: line 1: "));
  }
  const Scanned mixed = scanned_by("dda", "{\"line\": [0,0,1]}\n{\"line\": [0,0,1,0]}\n");
  EXPECT_EQ(mixed.outcome.status, 3);
  ASSERT_EQ(mixed.answers.size(), 2u);
  EXPECT_EQ(mixed.answers[1]["pixels"].size(), 2u);
}

TEST(Scan, DegenerateTrianglesCoverNothing) {
  EXPECT_TRUE(answer("edge-function", R"({"triangle": [[0,0],[4,4],[8,8]]})")["pixels"].empty());
  EXPECT_TRUE(answer("scan-line", R"({"triangle": [[0,0],[4,4],[8,8]]})")["pixels"].empty());
}

TEST(Scan, WrongUsage) {
  EXPECT_EQ(scanned_by("nothing", "").outcome.status, 2);
  EXPECT_EQ(scanned_by("dda", "", {"--arithmetic", "float16"}).outcome.status, 2);
  EXPECT_EQ(scanned_by("edge-function", "", {"--subpixel-bits", "17"}).outcome.status, 2);
  EXPECT_EQ(scanned_by("dda", "", {"--subpixel-bits", "8"}).outcome.status, 2);
}

TEST(Scan, OptionsThatWouldChangeNothingAreRefused) {
  const auto expect_refusal = [](const std::string& algorithm, const char* option,
                                 const std::string& said) {
    const Outcome outcome = scanned_by(algorithm, "", {option}).outcome;
    EXPECT_EQ(outcome.status, 2) << algorithm;
    EXPECT_EQ(outcome.err, "fathom: error: " + said + "\n");
  };
  for (const std::string algorithm :
       {"line-forms", "inside", "convexity", "tessellate", "convex-hull"}) {
    expect_refusal(algorithm, "--trace",
                   "--trace: " + algorithm + " shows no steps; leave the option out");
    expect_refusal(algorithm, "--runs",
                   "--runs: " + algorithm + " draws no pixels; leave the option out");
  }
  expect_refusal("flood", "--trace", "--trace: flood shows no steps; leave the option out");
  EXPECT_EQ(answer("flood", R"({"grid": ["aa"], "seed": [1,0]})", {"--runs"})["runs"],
            Json::parse("[[0,0,2]]"));
}

}  // namespace
}  // namespace fathom::test
