// fathom clip: JSON lines in, JSON lines out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

struct Clipped {
  Outcome outcome;
  std::vector<Json> answers;
};

Clipped clipped_by(const std::string& algorithm, const std::string& cases,
                   std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"clip", "--algorithm", algorithm});
  Clipped result{run_fathom(options, {.input = cases}), {}};
  std::istringstream lines(result.outcome.out);
  for (std::string line; std::getline(lines, line);) result.answers.push_back(Json::parse(line));
  return result;
}

/// The one answer to one case.
Json answer(const std::string& algorithm, const std::string& object,
            const std::vector<std::string>& options = {}) {
  const Clipped clipped = clipped_by(algorithm, object + "\n", options);
  EXPECT_EQ(clipped.outcome.status, 0) << clipped.outcome.err;
  EXPECT_EQ(clipped.answers.size(), 1u);
  return clipped.answers.empty() ? Json() : clipped.answers[0];
}

TEST(Clip, NamedDegenerateCasesAnswerTheFileOfAnswers) {
  const std::string folder = source_dir() / "data/clipping/";
  const Outcome outcome = run_fathom(
      {"clip", "--algorithm", "weiler-atherton", "--exact", folder + "degenerate.jsonl"});
  std::ifstream stream(folder + "degenerate.answers.jsonl");
  const std::string expected{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(outcome.out, expected);
}

// The same regions, found by CGAL, are the same text.
TEST(Clip, NamedDegenerateCasesByCgalToo) {
  const std::string folder = source_dir() / "data/clipping/";
  const std::string cases = folder + "degenerate.jsonl";
  const Outcome ours = run_fathom({"clip", "--algorithm", "weiler-atherton", "--exact", cases});
  const Outcome cgal = run_fathom({"clip", "--algorithm", "cgal", "--exact", cases});
  EXPECT_EQ(cgal.status, 0) << cgal.err;
  EXPECT_EQ(cgal.out, ours.out);
  const Outcome both =
      run_fathom({"clip", "--algorithm", "weiler-atherton", "--against", "cgal", cases});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(both.err, "");
  std::istringstream lines(both.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(Json::parse(line)["against"],
              Json::parse(R"({"algorithm": "cgal", "difference": null})"));
  EXPECT_GE(count, 130U);
}

const std::string notched_case = R"({"subject": [[[0,0],[4,0],[4,4],[3,1],[1,1],[0,4]]],)"
                                 R"( "clip": [[[-1,2],[5,2],[5,3],[-1,3]]]})";

// Sutherland–Hodgman's ring bridges the notch: the same region, but not the same border.
TEST(Clip, AgainstFindsTheBridgingEdge) {
  const Clipped clipped = clipped_by(
      "sutherland-hodgman", "\n" + notched_case + "\n" + notched_case, {"--against", "cgal"});
  EXPECT_EQ(clipped.outcome.status, 1);
  ASSERT_EQ(clipped.answers.size(), 2U);
  EXPECT_EQ(clipped.answers[0]["area_exact"], "1");
  EXPECT_EQ(clipped.answers[0]["against"], Json::parse(R"({"algorithm": "cgal", "difference":
              {"kind": "border", "only": "sutherland-hodgman",
               "edge": [["2/3", "2"], ["10/3", "2"]]}})"));
  // Standard error names the first.
  EXPECT_EQ(clipped.outcome.err,
            "fathom: standard input: line 2: the regions are the same, but only sutherland-hodgman "
            "has a border from (2/3, 2) to (10/3, 2)\n");
}

const std::string decomposed_case = R"({"decompose": true, )" + notched_case.substr(1);

// In convex pieces it has the right border. Only Sutherland–Hodgman takes "decompose", on either
// side.
TEST(Clip, AgainstGivesEachAlgorithmItsOwnKeys) {
  const std::string ours = "sutherland-hodgman";
  const Json by_ours = answer(ours, decomposed_case), plain = answer("cgal", notched_case);
  for (const std::string other : {"cgal", "weiler-atherton"})
    for (const bool is_first : {true, false}) {
      const Json both =
          answer(is_first ? ours : other, decomposed_case, {"--against", is_first ? other : ours});
      EXPECT_EQ(both["against"]["algorithm"], is_first ? other : ours);
      EXPECT_TRUE(both["against"]["difference"].is_null()) << both;
      EXPECT_EQ(both["polygons"], (is_first ? by_ours : plain)["polygons"]);
    }
  // With itself over exact numbers it keeps the key: the pieces are compared with pieces.
  const std::string squares = R"({"decompose": true, "subject": [[[0,0],[4,0],[4,4],[2,2],[0,4]]],)"
                              R"( "clip": [[[0,0],[4,0],[4,4],[0,4]]]})";
  const Json same = answer(ours, squares, {"--kernel", "double", "--against", ours});
  EXPECT_TRUE(same["against"]["difference"].is_null()) << same;
  EXPECT_EQ(same["polygons"].size(), 2U);
}

// Whose key it is not is said.
TEST(Clip, MessagesAboutKeysNameTheAlgorithm) {
  const auto expect_error = [](const std::string& algorithm, const std::string& object,
                               const std::string& error,
                               const std::vector<std::string>& options = {}) {
    const Clipped clipped = clipped_by(algorithm, object, options);
    EXPECT_EQ(clipped.outcome.status, 3);
    EXPECT_EQ(clipped.outcome.err, "fathom: error: standard input: line 1: " + error + "\n");
    EXPECT_EQ(clipped.answers.at(0), Json({{"error", error}}));
  };
  const std::string no_decompose = "\"decompose\" is not a key of ";
  for (const std::string name : {"weiler-atherton", "cgal"})
    expect_error(name, decomposed_case, no_decompose + name + "; it takes subject, clip, op");
  // Neither of the two takes it.
  expect_error("cgal", decomposed_case, no_decompose + "cgal; it takes subject, clip, op",
               {"--against", "weiler-atherton"});
  for (const std::string name : {"cohen-sutherland", "liang-barsky"})
    expect_error(name, R"({"line": []})",
                 "\"line\" is not a key of " + name + "; it takes segment, window");
  expect_error(
      "sutherland-hodgman", R"({"polygon": []})",
      "\"polygon\" is not a key of sutherland-hodgman; it takes subject, clip, op, decompose");
  const std::string in_space = R"({"polygon3": [[0,0,0],[2,0,0],[0,2,0]], "planes": [[1,0,0,-1]])";
  for (const std::string name : {"sutherland-hodgman", "plane"})
    expect_error(name, in_space + R"(, "clip": []})",
                 "\"clip\" is not a key of " + name +
                     " with polygon3; it takes polygon3, planes, attributes");
  expect_error("plane", R"({"planes": []})",
               "\"planes\" is not a key of plane; it takes plane, triangle, eye, points, line");
  expect_error("sutherland-hodgman", in_space + "}",
               "--against cgal: \"polygon3\" is not a key of cgal; it takes subject, clip, op",
               {"--against", "cgal"});
  expect_error("sutherland-hodgman", R"({"polygon3": []})", "\"planes\" is missing",
               {"--against", "plane"});
  // What only the second cannot do, it says.
  expect_error("weiler-atherton", R"({"subject": [], "clip": [], "op": "difference"})",
               "--against sutherland-hodgman: sutherland-hodgman does intersections only; "
               "weiler-atherton does differences and unions",
               {"--against", "sutherland-hodgman"});
  expect_error("homogeneous", R"({"segment": [[0,0,0,1],[1,1,1,1]], "attributes": [[0],[1]]})",
               "\"attributes\" is not a key of homogeneous with segment; it takes segment, volume, "
               "hourglass, after_division");
  expect_error("homogeneous", R"({"polygon": [], "planes": []})",
               "\"planes\" is not a key of homogeneous with polygon; it takes polygon, volume, "
               "hourglass, after_division, attributes");
  // Keys that do not go together.
  expect_error("homogeneous", R"({"segment": [[0,0,0,1],[1,1,1,1]], "polygon": [[0,0,0,1]]})",
               "expected \"polygon\" or \"segment\", not both");
  expect_error("homogeneous", R"({"volume": "opengl"})", "\"polygon\" or \"segment\" is missing");
  for (const std::string subject :
       {R"("segment": [[0,0,0,1],[1,1,1,1]])", R"("polygon": [[0,0,0,1],[1,0,0,1],[0,1,0,1]])"})
    expect_error("homogeneous", "{" + subject + R"(, "hourglass": "both", "after_division": true})",
                 "\"hourglass\": \"both\" has no meaning with \"after_division\", which leaves no "
                 "lower half; leave one of them out");
  expect_error("plane", R"({"plane": [1,0,0,0], "points": [], "eye": [1,1,1]})",
               "\"eye\" needs a triangle; add \"triangle\" or leave out \"eye\"");
}

// Sutherland–Hodgman begins its rings elsewhere, keeps straight corners, and puts what it clips of
// all rings into one polygon. Only the last is a difference.
TEST(Clip, AgainstLooksAtPolygonsNotAtHowTheyAreWritten) {
  const std::string window = R"( "clip": [[[-1,2],[9,2],[9,5],[-1,5]]]})";
  const std::string square = R"({"subject": [[[4,4],[0,4],[0,0],[2,0],[4,0]]],)" + window;
  const Clipped same = clipped_by("sutherland-hodgman", square, {"--against", "cgal"});
  EXPECT_EQ(same.outcome.status, 0) << same.outcome.err;
  EXPECT_TRUE(same.answers.at(0)["against"]["difference"].is_null());
  EXPECT_NE(same.answers[0]["polygons"], answer("cgal", square)["polygons"]);
  const std::string two =
      R"({"subject": [[[0,0],[4,0],[4,4],[0,4]], [[5,0],[6,0],[6,4],[5,4]]],)" + window;
  const Clipped together = clipped_by("sutherland-hodgman", two, {"--against", "cgal"});
  EXPECT_EQ(together.outcome.status, 1);
  EXPECT_EQ(together.answers.at(0)["against"]["difference"]["kind"], "polygons");
  EXPECT_THAT(together.outcome.err, HasSubstr("the borders are the same, but only "));
}

// What rounding does to a region is a piece of it, with its area.
TEST(Clip, AgainstFindsWhatRoundingChanges) {
  const Clipped clipped = clipped_by("weiler-atherton", notched_case,
                                     {"--kernel", "double", "--against", "weiler-atherton"});
  EXPECT_EQ(clipped.outcome.status, 1);
  ASSERT_EQ(clipped.answers.size(), 1U);
  const Json& difference = clipped.answers[0]["against"]["difference"];
  EXPECT_EQ(difference["kind"], "region");
  EXPECT_EQ(difference["only"], "weiler-atherton");
  // A triangle between 1/3, as it is and as the crossing was rounded, 3/5 and 2 2/3 ulps.
  EXPECT_EQ(difference["area"], "1/8444249301319680");
  EXPECT_THAT(clipped.outcome.err,
              HasSubstr("only weiler-atherton has a piece of area 1/8444249301319680 around "));
  // Where nothing is rounded, there is no difference.
  const std::string squares =
      R"({"subject": [[[0,0],[4,0],[4,4],[0,4]]], "clip": [[[2,2],[6,2],[6,6],[2,6]]]})";
  EXPECT_EQ(clipped_by("weiler-atherton", squares, {"--kernel", "double", "--against", "cgal"})
                .outcome.status,
            0);
}

TEST(Clip, AgainstComparesSegmentsToo) {
  const std::string corner = R"({"segment": [[0,2],[2,0]], "window": [1,1,6,3]})";
  const Clipped same = clipped_by("cohen-sutherland", corner, {"--against", "liang-barsky"});
  EXPECT_EQ(same.outcome.status, 0);
  EXPECT_TRUE(same.answers[0]["against"]["difference"].is_null());
  const std::string slanted = R"({"segment": [[0,0],[3,7]], "window": [1,1,6,3]})";
  const Clipped rounded =
      clipped_by("cohen-sutherland", slanted, {"--kernel", "double", "--against", "liang-barsky"});
  EXPECT_EQ(rounded.outcome.status, 1);
  const Json& difference = rounded.answers[0]["against"]["difference"];
  EXPECT_EQ(difference["kind"], "value");
  EXPECT_EQ(difference["at"], "/segment/0/1");
  EXPECT_EQ(difference["liang-barsky"], "7/3");
  EXPECT_TRUE(difference.contains("cohen-sutherland in binary64"));
}

// A case that cannot be done weighs more than one that differs; those after it are answered.
TEST(Clip, AgainstGoesOnAfterBadCases) {
  const Clipped clipped =
      clipped_by("sutherland-hodgman",
                 notched_case + "\n" + R"({"subject": [[[0,0],[1,1],[0,0]]], "clip": []})" + "\n" +
                     notched_case,
                 {"--against", "cgal"});
  EXPECT_EQ(clipped.outcome.status, 3);
  ASSERT_EQ(clipped.answers.size(), 3U);
  EXPECT_TRUE(clipped.answers[1].contains("error"));
  EXPECT_FALSE(clipped.answers[1].contains("against"));
  EXPECT_EQ(clipped.answers[2]["against"]["difference"]["kind"], "border");
}

// Two corners are a list of two also where they are text, which JSON could take for a key.
TEST(Clip, StepsOfSutherlandHodgmanShowBothEndsOfTheirEdge) {
  const std::string object =
      R"({"subject": [[[0,0],[4,0],[4,4],[0,4]]], "clip": [[[1,1],[5,1],[5,3]]]})";
  for (const bool exact : {false, true}) {
    const Json trace = answer("sutherland-hodgman", object,
                              exact ? std::vector<std::string>{"--trace", "--exact"}
                                    : std::vector<std::string>{"--trace"})["trace"];
    const char* edges[] = {"[[1,1],[5,1]]", "[[5,1],[5,3]]", "[[5,3],[1,1]]"};
    ASSERT_EQ(trace.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      Json edge = trace[i]["edge"];
      if (exact)
        for (Json& corner : edge)
          for (Json& c : corner) c = std::stod(c.get<std::string>());
      EXPECT_EQ(edge, Json::parse(edges[i]));
    }
  }
}

TEST(Clip, TheTraceShowsListsAndWalks) {
  const Json trace =
      answer("weiler-atherton",
             R"({"subject": [[[0,0],[4,0],[4,4],[0,4]]], "clip": [[[2,2],[6,2],[6,6],[2,6]]]})",
             {"--trace", "--exact"})["trace"];
  EXPECT_EQ(trace["subject"], Json::parse(R"([[{"point": ["0", "0"]}, {"point": ["4", "0"]},
      {"point": ["4", "2"], "kind": "entering", "crossing": 0}, {"point": ["4", "4"]},
      {"point": ["2", "4"], "kind": "leaving", "crossing": 1}, {"point": ["0", "4"]}]])"));
  EXPECT_EQ(trace["clip"], Json::parse(R"([[{"point": ["2", "2"]},
      {"point": ["4", "2"], "kind": "entering", "crossing": 0}, {"point": ["6", "2"]},
      {"point": ["6", "6"]}, {"point": ["2", "6"]},
      {"point": ["2", "4"], "kind": "leaving", "crossing": 1}]])"));
  EXPECT_EQ(trace["walks"], Json::parse(R"([[
      {"from": ["4", "2"], "along": "subject", "crossing": 0},
      {"from": ["4", "4"], "along": "subject"},
      {"from": ["2", "4"], "along": "clip", "crossing": 1},
      {"from": ["2", "2"], "along": "clip"}]])"));
}

TEST(Clip, AreaIsAFractionAndSeventeenDigits) {
  const std::string object =
      R"({"name": "n", "subject": [[[0,0],[3,1],[0,1]]], "clip": [[[0,1],[1,0],[2,2]]]})";
  const Json exact = answer("weiler-atherton", object, {"--exact"});
  EXPECT_EQ(exact["name"], "n");
  EXPECT_EQ(exact["area_exact"], "27/40");
  EXPECT_EQ(exact["area"], "6.7500000000000000e-1");
  EXPECT_EQ(exact["polygons"].size(), 1u);
  for (const Json& p : exact["polygons"][0][0]) EXPECT_TRUE(p[0].is_string() && p[1].is_string());
  const Json rounded = answer("weiler-atherton", object);
  EXPECT_EQ(rounded["area_exact"], "27/40");
  EXPECT_TRUE(rounded["polygons"][0][0][0][0].is_number());
  const Json binary64 = answer("weiler-atherton", object, {"--kernel", "double"});
  EXPECT_FALSE(binary64.contains("area_exact"));
  // Six crossings, cross products and sums below 2, each rounded by at most 2^-53: far below 1e-14.
  EXPECT_NEAR(std::stod(binary64["area"].get<std::string>()), 0.675, 1e-14);
}

TEST(Clip, AreaOfTooManyDigitsIsLeftOut) {
  // Coordinates of 1e±150 give denominators of thousands of digits.
  const Json huge =
      answer("weiler-atherton", R"({"subject": [[[1e-150,3e-151],[7e150,1e-149],[2e149,9e150]]],)"
                                R"( "clip": [[[1e-150,1e150],[1e150,3e-150],[8e150,7e150]]]})");
  EXPECT_FALSE(huge.contains("area_exact"));
  EXPECT_THAT(huge["area"].get<std::string>(), HasSubstr("e300"));
}

TEST(Clip, CasesThatCannotBeDoneDoNotStopTheOthers) {
  const std::string square = "[[0,0],[4,0],[4,4],[0,4]]";
  const std::string good = R"({"name": "good", "subject": [)" + square + R"(], "clip": []})";
  const Clipped clipped =
      clipped_by("weiler-atherton",
                 good + "\n" +
                     R"({"name": "bow", "subject": [[[0,0],[4,4],[4,0],[0,4]]], "clip": []})"
                     "\n" +
                     R"({"name": 3, "subject": [[[0,0],[4,0],[4,NaN]]], "clip": []})"
                     "\n" +
                     R"({"name": "far", "subject": [], "clip": [)" + square +
                     R"(, [[0,0],[1e999,0],[1,1]]]})"
                     "\n" +
                     R"({"name": "two", "subject": [[[0,0],[1,1],[0,0]]], "clip": []})"
                     "\n" +
                     R"({"name": "flat", "subject": [[[0,0],[1,1],[2,2]]], "clip": []})"
                     "\n" +
                     R"({"name": "typo", "subject": [], "clip": [], "operation": "difference"})"
                     "\n" +
                     R"({"name": "text", "subject": [[["0",0],[1,1],[2,2]]], "clip": []})"
                     "\n" +
                     R"({"name": "half", "subject": [)"
                     "\n\n" +
                     good + "\n");
  EXPECT_EQ(clipped.outcome.status, 3);
  const std::vector<std::string> errors{
      "",
      "subject ring 0 is not simple: its edges 0 and 2 meet at (2, 2)",
      "subject ring 0 has a coordinate that is not finite, at corner 2",
      "clip ring 1 has a coordinate that is not finite, at corner 1",
      "subject ring 0 has 2 distinct corners; expected at least 3",
      "subject ring 0 has no area: its corners lie on one line",
      "\"operation\" is not a key of weiler-atherton; it takes subject, clip, op",
      "subject ring 0, corner 0[0]: expected finite numbers, found string",
      "not JSON at character 30",
      ""};
  ASSERT_EQ(clipped.answers.size(), errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_TRUE(clipped.answers[i].contains("name"));
    EXPECT_EQ(clipped.answers[i].value("error", ""), errors[i]);
    EXPECT_EQ(clipped.answers[i].contains("polygons"), errors[i].empty());
  }
  EXPECT_EQ(clipped.answers[2]["name"], 3);
  EXPECT_EQ(
      clipped.outcome.err,
      "fathom: error: standard input: line 2: subject ring 0 is not simple: its edges 0 and 2 "
      "meet at (2, 2) (the first of 8 cases of 10 that cannot be done)\n");
}

TEST(Clip, SegmentsWithBothTraces) {
  const std::string object = R"({"segment": [[-2,3],[2,9]], "window": [0,0,4,4]})";
  const Json cohen = answer("cohen-sutherland", object, {"--trace", "--exact"});
  EXPECT_TRUE(cohen["segment"].is_null());
  ASSERT_EQ(cohen["trace"].size(), 2u);
  EXPECT_EQ(cohen["trace"][0]["outcodes"], Json::parse(R"(["0001", "1000"])"));
  EXPECT_EQ(cohen["trace"][0]["test"], 4);
  EXPECT_EQ(cohen["trace"][0]["edge"], "left");
  EXPECT_EQ(cohen["trace"][1]["and"], "1000");
  EXPECT_EQ(cohen["trace"][1]["test"], 2);
  const Json liang = answer("liang-barsky", R"({"segment": [[0,2],[2,0]], "window": [1,1,6,3]})",
                            {"--trace", "--exact"});
  EXPECT_EQ(liang["segment"], Json::parse(R"([["1", "1"], ["1", "1"]])"));  // a corner touched
  std::string order;
  for (const Json& parameter : liang["trace"]["parameters"])
    order += parameter["edge"].get<std::string>() + " " + parameter["t"].get<std::string>() + ", ";
  EXPECT_EQ(order, "top -1/2, left 1/2, bottom 1/2, right 3, ");
  EXPECT_EQ(liang["trace"]["t_entering"], "1/2");
}

TEST(Clip, SutherlandHodgmanRingByRingAndInSpace) {
  const std::string notched = R"({"subject": [[[0,0],[4,0],[4,4],[3,1],[1,1],[0,4]]],)"
                              R"( "clip": [[[-1,2],[5,2],[5,3],[-1,3]]]})";
  const Json one = answer("sutherland-hodgman", notched, {"--trace"});
  EXPECT_EQ(one["polygons"].size(), 1u);
  EXPECT_EQ(one["area_exact"], "1");
  EXPECT_EQ(one["trace"].size(), 4u);
  EXPECT_EQ(answer("weiler-atherton", notched)["polygons"].size(), 2u);
  std::string in_pieces = notched;
  in_pieces.insert(1, R"("decompose": true, )");
  const Json pieces = answer("sutherland-hodgman", in_pieces);
  EXPECT_EQ(pieces["polygons"].size(), 2u);
  EXPECT_EQ(pieces["area_exact"], "1");
  const Json space = answer("sutherland-hodgman",
                            R"({"polygon3": [[0,0,0],[2,0,0],[0,2,0]], "planes": [[1,0,0,-1]], )"
                            R"("attributes": [[0],[2],[4]]})",
                            {"--trace"});
  EXPECT_EQ(space["polygon3"], Json::parse("[[0.0,0,0],[1,0,0],[1,1,0],[0,2,0]]"));
  EXPECT_EQ(space["attributes"], Json::parse("[[0.0],[1],[3],[4]]"));
  EXPECT_EQ(space["trace"].size(), 1u);
  const Clipped concave =
      clipped_by("sutherland-hodgman", R"({"subject": [], "clip": [[[0,0],[4,0],[1,1],[0,4]]]})"
                                       "\n"
                                       R"({"subject": [], "clip": [], "op": "difference"})"
                                       "\n");
  EXPECT_EQ(concave.outcome.status, 3);
  EXPECT_THAT(concave.answers[0]["error"].get<std::string>(), HasSubstr("not convex at (1, 1)"));
  EXPECT_THAT(concave.answers[1]["error"].get<std::string>(), HasSubstr("intersections only"));
}

TEST(Clip, HomogeneousBeforeAndAfterTheDivision) {
  const std::string open = R"({"polygon": [[0,0,0.5,1.5],[0.25,0,0.5,1.5],[0,0,-7,-1]])";
  const Json before = answer("homogeneous", open + "}", {"--trace"});
  for (const Json& p : before["polygon"]) EXPECT_GT(p[3].get<double>(), 0);
  EXPECT_EQ(before["polygon"][0], Json::parse("[0.0, 0, -1, 1]"));
  EXPECT_EQ(before["trace"].size(), 6u);
  const Json after = answer("homogeneous", open + R"(, "after_division": true})");
  EXPECT_EQ(after["polygon"][0], Json::parse("[0.0, 0, 1, 1]"));  // the far plane: wrong
  const Json halves = answer(
      "homogeneous", R"({"segment": [[0,0,0,1],[-1,0,0,-2]], "hourglass": "both"})", {"--exact"});
  EXPECT_EQ(halves["segment"], Json::parse(R"([["0","0","0","1"],["-1/4","0","0","1/4"]])"));
  EXPECT_EQ(halves["lower"], Json::parse(R"([["-1/2","0","0","-1/2"],["-1","0","0","-2"]])"));
}

// The line of docs/clipping.md from z = 1/3 to a point behind the eye: visible up to the near
// plane.
TEST(Clip, ASegmentAfterTheDivisionIsKeptOnTheWrongSide) {
  const std::string line = R"({"segment": [[0,0,0.5,1.5],[0,0,-7,-1]])";
  EXPECT_EQ(answer("homogeneous", line + R"(, "after_division": false})", {"--exact"})["segment"],
            Json::parse(R"([["0","0","1/2","3/2"],["0","0","-1","1"]])"));
  for (const std::string kernel : {"exact", "double"}) {
    const Json after = answer("homogeneous", line + R"(, "after_division": true})",
                              {"--kernel", kernel, "--trace"});
    EXPECT_EQ(after["segment"], Json::parse("[[0.0,0.0,0.3333333333333333,1.0],[0.0,0.0,1.0,1.0]]"))
        << kernel;
    ASSERT_EQ(after["trace"].size(), 1U);
    EXPECT_EQ(after["trace"][0]["parameters"].size(), 6U);
    EXPECT_EQ(after["trace"][0]["t_leaving"], 0.1);  // (1 − 1/3) / (7 − 1/3)
  }
  // Both orders agree in front of the eye, where the volume says what is near.
  const std::string ahead = R"({"segment": [[0,0,-1,2],[0,0,1,2]], "volume": "zero-one")";
  EXPECT_EQ(answer("homogeneous", ahead + "}", {"--exact"})["segment"],
            Json::parse(R"([["0","0","0","2"],["0","0","1","2"]])"));
  EXPECT_EQ(answer("homogeneous", ahead + R"(, "after_division": true})", {"--exact"})["segment"],
            Json::parse(R"([["0","0","0","1"],["0","0","1/2","1"]])"));
  EXPECT_TRUE(answer("homogeneous",
                     R"({"segment": [[5,0,0,1],[9,0,0,1]], "after_division": true})")["segment"]
                  .is_null());
}

// The trace shows where the polygon goes wrong: its corner at z = 7 is cut at the far plane, last.
TEST(Clip, TheTraceAfterTheDivisionHasEachPlane) {
  const Json after =
      answer("homogeneous",
             R"({"polygon": [[0,0,0.5,1.5],[0.25,0,0.5,1.5],[0,0,-7,-1]], "after_division": true})",
             {"--trace", "--exact"});
  std::string planes;
  for (const Json& step : after["trace"]) planes += step["plane"].get<std::string>() + " ";
  EXPECT_EQ(planes, "left right bottom top near far ");
  EXPECT_EQ(after["trace"][4]["polygon"],
            Json::parse(R"([["0","0","1/3","1"],["1/6","0","1/3","1"],["0","0","7","1"]])"));
  EXPECT_EQ(after["trace"][5]["polygon"], after["polygon"]);
}

// A triangle with corners in both halves; the attribute is x.
TEST(Clip, AttributesOfBothHalves) {
  const Json halves =
      answer("homogeneous",
             R"({"polygon": [[0,0,0,1],[1,0,0,1],[-1,-1,0,-2]], "hourglass": "both",)"
             R"( "attributes": [[0],[1],[-1]]})",
             {"--exact"});
  for (const auto& [points, attributes] :
       {std::pair{"polygon", "attributes"}, std::pair{"lower", "lower_attributes"}}) {
    EXPECT_GE(halves[points].size(), 3U);
    ASSERT_EQ(halves[points].size(), halves[attributes].size());
    for (std::size_t i = 0; i < halves[points].size(); ++i)
      EXPECT_EQ(halves[points][i][0], halves[attributes][i][0]);
  }
}

TEST(Clip, PlaneSidesDistancesAndLine) {
  const Json plane = answer(
      "plane", R"({"plane": [1,1,1,-1], "points": [[1,0,0],[0,0,0],[2,3,4],[2,3,4,-1],[1,1,1,0]],)"
               R"( "line": [[0,0,0],[2,3,4]]})");
  EXPECT_EQ(plane["sides"], Json::parse("[0, -1, 1, -1, 1]"));
  EXPECT_EQ(plane["distances"][2], 4.618802153517006116);  // 8/√3
  EXPECT_TRUE(plane["distances"][4].is_null());
  EXPECT_EQ(plane["t"], 1.0 / 9);
  // Through (1,0,0), (0,1,0), (0,0,1): x + y + z = 1, twice the area √3; reversed, all turns round.
  const std::string tip = R"(, "eye": [2,2,2], "points": [[0,0,0]]})";
  const Json front = answer("plane", R"({"triangle": [[1,0,0],[0,1,0],[0,0,1]])" + tip);
  EXPECT_EQ(front["plane"], Json::parse("[1, 1, 1, -1]"));
  EXPECT_EQ(front["normal"], Json::parse("[1, 1, 1]"));
  EXPECT_EQ(front["twice_area"], 1.7320508075688772);
  EXPECT_EQ(front["facing"], "front");
  EXPECT_EQ(front["n_dot_v"], 5);
  EXPECT_EQ(front["sides"], Json::parse("[-1]"));
  const Json back = answer("plane", R"({"triangle": [[1,0,0],[0,0,1],[0,1,0]])" + tip);
  EXPECT_EQ(back["normal"], Json::parse("[-1, -1, -1]"));
  EXPECT_EQ(back["facing"], "back");
  EXPECT_EQ(back["sides"], Json::parse("[1]"));
  EXPECT_EQ(
      answer("plane", R"({"triangle": [[1,0,0],[0,1,0],[0,0,1]], "eye": [3,-1,-1]})")["facing"],
      "edge on");
}

TEST(Clip, ATriangleWithoutAreaHasNoPlane) {
  const auto error_of = [](const std::string& object, const std::string& kernel) {
    return clipped_by("plane", object, {"--kernel", kernel}).answers.at(0).value("error", "");
  };
  const std::string on_a_line = R"({"triangle": [[0,0,0],[1,1,1],[2,2,2]], "eye": [1,0,0]})";
  for (const std::string kernel : {"exact", "double"}) {
    EXPECT_EQ(error_of(on_a_line, kernel), "the triangle has no area: its corners lie on one line");
    EXPECT_EQ(error_of(R"({"plane": [0,0,0,1], "points": []})", kernel),
              "the plane's normal (A, B, C) is zero; expected a plane");
  }
  // An area of 10⁻⁴⁰⁰ is one, but binary64 has no such number.
  const std::string tiny = R"({"triangle": [[0,0,0],[1e-200,0,0],[0,1e-200,0]], "eye": [0,0,1]})";
  EXPECT_EQ(error_of(tiny, "double"),
            "the triangle's normal is rounded to zero; --kernel exact has it");
  EXPECT_EQ(answer("plane", tiny)["facing"], "front");
}

TEST(Clip, WrongUsage) {
  EXPECT_EQ(run_fathom({"clip"}).status, 2);
  EXPECT_THAT(run_fathom({"clip", "--algorithm", "greiner-hormann"}).err,
              HasSubstr("one of weiler-atherton, sutherland-hodgman"));
  EXPECT_THAT(run_fathom({"clip", "--algorithm", "plane", "--kernel", "single"}).err,
              HasSubstr("neither exact nor double"));
  EXPECT_EQ(run_fathom({"clip", "--algorithm", "plane", "no-such-file"}).status, 3);
  const auto expect_refused = [](std::vector<std::string> options, const std::string& said) {
    options.insert(options.begin(), {"clip", "--algorithm"});
    const Outcome outcome = run_fathom(options);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, "fathom: error: " + said + "\n");
    EXPECT_EQ(outcome.out, "");
  };
  expect_refused({"cgal", "--kernel", "double"},
                 "--kernel double: cgal clips exactly; leave the option out");
  expect_refused({"cgal", "--trace"}, "--trace: cgal shows no steps; weiler-atherton does");
  expect_refused({"cgal", "--against", "cgal"},
                 "--against cgal: an algorithm is not compared with itself");
  EXPECT_THAT(run_fathom({"clip", "--algorithm", "cgal", "--against", "vatti"}).err,
              HasSubstr("--against: 'vatti'"));
  const Outcome help = run_fathom({"clip", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, HasSubstr("Examples:\n"));
  EXPECT_THAT(help.out, HasSubstr("{\"triangle\": [[1,0,0],[0,1,0],[0,0,1]], \"eye\": [2,2,2]}"));
}

}  // namespace
}  // namespace fathom::test
