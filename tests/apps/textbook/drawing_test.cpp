// --draw of scan, clip and pipeline trace: the numbers of a picture are those of --trace.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

std::string unescaped(std::string text) {
  for (std::size_t at = 0; (at = text.find("&quot;", at)) != std::string::npos;)
    text.replace(at, 6, "\"");
  return text;
}

/// A drawn case: the answer with its trace, and the picture, which is well-formed.
struct Drawn {
  Json answer;
  std::string svg;

  /// The numbers that the picture has under a name, in its order.
  [[nodiscard]] Json values(const std::string& of) const {
    Json list = Json::array();
    const std::regex number("data-of=\"" + of + "\" data-value=\"([^\"]*)\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), number), end; it != end; ++it)
      list.push_back(Json::parse(unescaped((*it)[1])));
    return list;
  }
};

/// The places of a polygon's corners on the page.
using Corners = std::vector<std::array<double, 2>>;

/// The polygons of a class, in the picture's order.
std::vector<Corners> polygons_of(const std::string& svg, const std::string& kind) {
  std::vector<Corners> list;
  const std::regex polygon("<polygon points=\"([^\"]*)\" class=\"" + kind + "\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), polygon), end; it != end; ++it) {
    std::istringstream points((*it)[1].str());
    list.emplace_back();
    char comma = 0;
    for (double x = 0, y = 0; points >> x >> comma >> y;) list.back().push_back({x, y});
  }
  return list;
}

/// How far a polygon extends on the page in x.
double width_of(const Corners& corners) {
  const auto [left, right] = std::minmax_element(corners.begin(), corners.end());
  return (*right)[0] - (*left)[0];
}

/// A label of a point or a region, and where its letters are.
struct Label {
  std::string words;
  double left = 0, right = 0, base = 0;
};

std::vector<Label> labels_of(const std::string& svg) {
  std::vector<Label> list;
  const std::regex label(
      "<text x=\"([^\"]*)\" y=\"([^\"]*)\" class=\"label\" text-anchor=\"(\\w+)\">([^<]*)<");
  for (std::sregex_iterator it(svg.begin(), svg.end(), label), end; it != end; ++it) {
    const std::string words = (*it)[4];
    // The minus sign has three bytes.
    const auto bytes = std::ranges::count_if(words, [](char c) { return (c & 0xC0) != 0x80; });
    const double width = 8 * static_cast<double>(bytes), x = std::stod((*it)[1]);
    const double left = (*it)[3] == "middle" ? x - width / 2 : x;
    list.push_back({words, left, left + width, std::stod((*it)[2])});
  }
  return list;
}

std::string on_one_line(std::string object) {
  std::erase(object, '\n');
  return object + "\n";
}

Drawn drawn(const std::vector<std::string>& command, const std::string& object) {
  const TestFolder folder;
  std::vector<std::string> arguments = command;
  arguments.insert(arguments.end(), {"--trace", "--draw", "steps.svg"});
  const Outcome outcome =
      run_fathom(arguments, {.folder = folder.path(), .input = on_one_line(object)});
  EXPECT_EQ(outcome.status, 0) << outcome.err << object;
  if (outcome.status != 0) return {};
  // Without --trace, the picture is the same and the answer has no trace.
  arguments = command;
  arguments.insert(arguments.end(), {"--draw", "again.svg"});
  const Outcome plain =
      run_fathom(arguments, {.folder = folder.path(), .input = on_one_line(object)});
  EXPECT_FALSE(Json::parse(plain.out).contains("trace"));
  EXPECT_EQ(folder.read("again.svg"), folder.read("steps.svg"));
  const Outcome parsed =
      run({python, "-c", "import xml.etree.ElementTree as e; e.parse('steps.svg')"},
          {.folder = folder.path()});
  EXPECT_EQ(parsed.status, 0) << parsed.err;
  return {Json::parse(outcome.out), folder.read("steps.svg")};
}

Drawn scanned(const std::string& algorithm, const std::string& object,
              std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"scan", "--algorithm", algorithm});
  return drawn(more, object);
}

Drawn clipped(const std::string& algorithm, const std::string& object,
              std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"clip", "--algorithm", algorithm});
  return drawn(more, object);
}

/// A member of each item of a list.
Json each(const Json& list, const std::string& key) {
  Json result = Json::array();
  for (const Json& item : list) result.push_back(item[key]);
  return result;
}

/// All numbers of nested lists.
Json flat(const Json& list) {
  Json result = Json::array();
  for (const Json& item : list) {
    if (item.is_array())
      for (const Json& number : flat(item)) result.push_back(number);
    else
      result.push_back(item);
  }
  return result;
}

TEST(Drawing, DecisionValuesAlongALine) {
  const std::pair<std::string, std::string> keys[] = {
      {"explicit", "minor"}, {"dda", "minor"}, {"bresenham", "error"}, {"midpoint", "d"}};
  for (const std::string line : {"[0,0,8,3]", "[3,7,-2,1]", "[5,5,5,5]"}) {
    for (const auto& [algorithm, key] : keys) {
      const Drawn picture = scanned(algorithm, R"({"line": )" + line + "}");
      EXPECT_EQ(picture.values(key), each(picture.answer["trace"]["steps"], key)) << algorithm;
    }
  }
  const Drawn exits = scanned("diamond-exit", R"({"line": [0.25,0.5,6.5,3]})", {"--exact"});
  ASSERT_FALSE(exits.values("enters").empty());
  EXPECT_EQ(exits.values("enters"), each(exits.answer["trace"]["steps"], "enters"));
  EXPECT_EQ(exits.values("leaves"), each(exits.answer["trace"]["steps"], "leaves"));
}

// y grows down: a line to the right and down goes south-east.
TEST(Drawing, TheMidpointsChoiceAsADirection) {
  const std::tuple<std::string, std::string, std::string> lines[] = {
      {"[0,0,8,3]", ">E<", ">SE<"},  {"[0,0,8,-3]", ">E<", ">NE<"},
      {"[0,0,-8,3]", ">W<", ">SW<"}, {"[0,0,-8,-3]", ">W<", ">NW<"},
      {"[0,0,3,8]", ">S<", ">SE<"},  {"[0,0,-3,-8]", ">N<", ">NW<"}};
  for (const auto& [line, along, both] : lines) {
    const std::string svg = scanned("midpoint", R"({"line": )" + line + "}").svg;
    std::set<std::string> directions;
    const std::regex choice("class=\"text-a\" text-anchor=\"middle\"(>[^<]*<)");
    for (std::sregex_iterator it(svg.begin(), svg.end(), choice), end; it != end; ++it)
      directions.insert((*it)[1]);
    EXPECT_EQ(directions, (std::set<std::string>{along, both})) << line;
  }
}

TEST(Drawing, CrossingsOfEachScanLine) {
  const std::string polygon = R"({"polygon": [[[1,1],[8,2],[9,9],[5,4],[2,8]]], "name": "a < b"})";
  for (const char* algorithm : {"even-odd", "non-zero"}) {
    const Drawn picture = scanned(algorithm, polygon, {"--exact"});
    Json crossings = Json::array();
    for (const Json& row : picture.answer["trace"])
      for (const Json& crossing : row["crossings"]) crossings.push_back(crossing["x"]);
    EXPECT_GT(crossings.size(), 16u);
    EXPECT_EQ(picture.values("crossings"), crossings);
  }
  EXPECT_FALSE(
      scanned("scan-line", R"({"triangle": [[1,1],[8,2],[4,7]]})").values("crossings").empty());
}

TEST(Drawing, EdgeFunctionsAtEachPixel) {
  const Drawn picture = scanned("edge-function", R"({"triangle": [[1,1],[8,2],[4,7]]})");
  EXPECT_EQ(picture.values("edges"), flat(each(picture.answer["trace"]["samples"], "edges")));
  EXPECT_GT(picture.values("edges").size(), 45u);
}

// Exercise 2 of the course: the values outside the triangle too, as numbers and as a picture.
TEST(Drawing, EdgeValuesOverTheImage) {
  const TestFolder folder;
  const std::string exercise =
      R"({"triangle": [[50,20],[200,150],[30,180]], "width": 256, "height": 256})";
  const auto asked = [&](const std::string& values) {
    const Outcome outcome =
        run_fathom({"scan", "--algorithm", "edge-values", "--values", values, "--draw", "e.svg"},
                   {.folder = folder.path(), .input = exercise});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? Json::parse(outcome.out) : Json();
  };
  const Json answer = asked("e.csv");
  ASSERT_EQ(answer["values"].size(), 256u);
  // e of the edge from P to Q at a centre: the textbook's formula with the sign of the inside.
  const double corners[3][2] = {{50, 20}, {200, 150}, {30, 180}};
  std::istringstream csv(folder.read("e.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "x,y,BC,CA,AB");
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const Json& values = answer["values"][y][x];
      ASSERT_EQ(values.size(), 3u);
      for (int k = 0; k < 3; ++k) {
        const double *p = corners[(k + 1) % 3], *q = corners[(k + 2) % 3];
        const double textbook = (x + 0.5 - p[0]) * (q[1] - p[1]) - (y + 0.5 - p[1]) * (q[0] - p[0]);
        EXPECT_EQ(values[k], -textbook);
      }
      std::getline(csv, line);
      ASSERT_EQ(line, std::to_string(x) + "," + std::to_string(y) + "," + values[0].dump() + "," +
                          values[1].dump() + "," + values[2].dump());
    }
  }
  Drawn picture{answer, folder.read("e.svg")};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int x = 32 * (2 * i + 1), y = 32 * (2 * j + 1);
      EXPECT_EQ(picture.values(std::to_string(x) + "," + std::to_string(y)),
                answer["values"][y][x]);
    }
  asked("e.npy");
  const Outcome read = run({python, "-c",
                            "import numpy as np; a = np.load('e.npy'); c = np.loadtxt('e.csv', "
                            "delimiter=',', skiprows=1);"
                            "assert a.shape == (256, 256, 3) and a.dtype == float;"
                            "assert (a.reshape(-1, 3) == c[:, 2:]).all()"},
                           {.folder = folder.path()});
  EXPECT_EQ(read.status, 0) << read.err;
}

TEST(Drawing, SignsOfARegionLieInTheImage) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(
      {"scan", "--algorithm", "edge-values", "--draw", "e.svg"},
      {.folder = folder.path(),
       .input = R"({"triangle": [[50,20],[200,150],[30,180]], "width": 256, "height": 256})"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string svg = folder.read("e.svg");
  const Corners image = polygons_of(svg, "thin").back();
  const std::vector<Label> labels = labels_of(svg);
  EXPECT_EQ(labels.size(), 7u);
  for (const Label& label : labels) {
    EXPECT_GE(label.left, image[0][0]) << label.words;
    EXPECT_LE(label.right, image[2][0]) << label.words;
    EXPECT_GE(label.base - 10, image[0][1]) << label.words;
    EXPECT_LE(label.base, image[2][1]) << label.words;
  }
}

TEST(Drawing, SegmentsInAWindow) {
  const std::string segment = R"({"segment": [[0,0],[9,6]], "window": [1,1,6,3]})";
  const Drawn cohen = clipped("cohen-sutherland", segment, {"--exact"});
  EXPECT_EQ(cohen.values("segment"), flat(each(cohen.answer["trace"], "segment")));
  for (const Json& step : cohen.answer["trace"])
    for (const Json& code : step["outcodes"])
      EXPECT_THAT(cohen.svg, HasSubstr(">" + code.get<std::string>() + "<"));
  const Drawn liang = clipped("liang-barsky", segment);
  Json t = Json::array();
  for (const Json& p : liang.answer["trace"]["parameters"]) t.push_back(p["t"]);
  EXPECT_EQ(liang.values("t"), t);
  EXPECT_EQ(liang.values("t_entering")[0], liang.answer["trace"]["t_entering"]);
}

TEST(Drawing, ThePolygonAfterEachEdge) {
  const Drawn plane =
      clipped("sutherland-hodgman", R"({"subject": [[[0,0],[4,0],[4,4],[3,1],[1,1],[0,4]]],
    "clip": [[[-1,2],[5,2],[5,3],[-1,3]]]})");
  EXPECT_EQ(plane.values("polygon"), flat(each(plane.answer["trace"], "polygon")));
  EXPECT_EQ(plane.values("edge"), flat(each(plane.answer["trace"], "edge")));
  const Drawn hourglass = clipped(
      "homogeneous", R"({"polygon": [[0,0,0.5,1.5],[0.25,0,0.5,1.5],[0,0,-7,-1]]})", {"--exact"});
  EXPECT_EQ(hourglass.values("polygon"), flat(each(hourglass.answer["trace"], "polygon")));
  const Drawn space = clipped(
      "plane", R"({"polygon3": [[0,0,0],[4,0,0],[0,4,1]], "planes": [[1,0,0,-2],[0,1,0,-1]]})");
  EXPECT_EQ(space.values("polygon3"), flat(each(space.answer["trace"], "polygon3")));
}

TEST(Drawing, BothListsAndTheWalks) {
  const Drawn picture =
      clipped("weiler-atherton", R"({"subject": [[[0,0],[4,0],[4,4],[3,1],[1,1],[0,4]]],
    "clip": [[[-1,2],[5,2],[5,3],[-1,3]]]})",
              {"--exact"});
  const Json& trace = picture.answer["trace"];
  for (const std::string side : {"subject", "clip"}) {
    Json points = Json::array();
    for (const Json& ring : trace[side]) points.push_back(each(ring, "point"));
    EXPECT_EQ(picture.values(side), flat(points));
  }
  ASSERT_EQ(trace["walks"].size(), 2u);
  Json walks = Json::array();
  for (const Json& walk : trace["walks"]) walks.push_back(each(walk, "from"));
  EXPECT_EQ(picture.values("walk"), flat(walks));
  // Numbers side by side would read as one.
  const std::vector<Label> labels = labels_of(picture.svg);
  EXPECT_EQ(labels.size(), 18u);
  for (const Label& a : labels) {
    for (const Label& b : labels) {
      const bool is_next = a.left < b.left && std::abs(a.base - b.base) < 10;
      EXPECT_TRUE(!is_next || b.left - a.right >= 4) << a.words << " " << b.words;
    }
  }
}

TEST(Drawing, ThePipelineOfAPixel) {
  const TestFolder folder;
  folder.write("s.obj",
               "v -2 -1 -2\nv 2 -1 -4\nv 0 1.5 -3\nv -2 -1.2 -4\nv 2 -0.8 -2\nv 0 1.4 -3.1\nf 1 2 "
               "3\nf 4 5 6\n");
  folder.write(
      "c.json",
      R"({"width": 12, "height": 9, "fx": 9, "fy": 9, "cx": 6, "cy": 4.5, "pixel_centre": 0.5,
    "world_to_camera": [[1,0,0,0],[0,-1,0,0],[0,0,-1,0]], "near": 1, "far": 10})");
  const auto asked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"pipeline", "trace", "s.obj", "--camera", "c.json", "--pixel", "6,4",
                               "--json", "--draw", "t.svg"});
    const Outcome outcome = run_fathom(more, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? Drawn{Json::parse(outcome.out), folder.read("t.svg")} : Drawn{};
  };
  const Drawn merged = asked({"--fragments", "--blend"});
  EXPECT_EQ(merged.values("window"), flat(each(merged.answer["clipping"], "window")));
  EXPECT_EQ(merged.values("window_z"), each(merged.answer["fragment_list"], "window_z"));
  Json stored = Json::array();
  for (const Json& step : merged.answer["output_merger"])
    for (const char* part : {"before", "fragment", "after"})
      stored.push_back(step[part]["stored"]["value"]);
  EXPECT_EQ(stored.size(), 6u);
  EXPECT_EQ(merged.values("stored"), stored);
  const Drawn painted = asked({"--hidden-surface", "painter"});
  const Json& polygons = painted.answer["painter"]["polygons"];
  EXPECT_GT(polygons.size(), 2u);
  EXPECT_EQ(painted.values("corner"), flat(each(polygons, "corners")));
  EXPECT_THAT(painted.svg, HasSubstr("split "));
}

// A few pixels of a large window are enlarged; the window is shown next to them.
TEST(Drawing, ASmallPrimitiveEnlarged) {
  const TestFolder folder;
  const Outcome outcome = run_fathom({"pipeline", "trace", source_dir() / "data/meshes/spot.obj",
                                      "--triangle", "238", "--pixel", "640,360", "--draw", "t.svg"},
                                     {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string svg = folder.read("t.svg");
  const auto triangles = polygons_of(svg, "b");
  ASSERT_EQ(triangles.size(), 1u);
  EXPECT_GT(width_of(triangles[0]), 200);
  const auto windows = polygons_of(svg, "soft");
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_NEAR(width_of(windows[1]), 208, 1);  // with a border, 260
  EXPECT_THAT(svg, HasSubstr("red frame: the part shown on the left"));
}

TEST(Drawing, IsRefusedInOneLine) {
  const TestFolder folder;
  const auto refused = [&](int status, const std::string& said,
                           const std::vector<std::string>& command, const std::string& input) {
    const Outcome outcome = run_fathom(command, {.folder = folder.path(), .input = input});
    EXPECT_EQ(outcome.status, status) << said;
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_TRUE(folder.names().empty());
  };
  refused(2, "does not end in .svg", {"scan", "--algorithm", "dda", "--draw", "a.png"}, "");
  refused(2, "--draw: flood shows no steps", {"scan", "--algorithm", "flood", "--draw", "a.svg"},
          "");
  refused(2, "--draw: cgal shows no steps", {"clip", "--algorithm", "cgal", "--draw", "a.svg"}, "");
  refused(2, "leave --runs out", {"scan", "--algorithm", "dda", "--runs", "--draw", "a.svg"}, "");
  refused(2, "--values is for edge-values", {"scan", "--algorithm", "dda", "--values", "a.csv"},
          "");
  refused(2, "does not end in .csv or .npy",
          {"scan", "--algorithm", "edge-values", "--values", "a.txt"}, "");
  refused(3, "at most 64 x 64 pixels", {"scan", "--algorithm", "dda", "--draw", "a.svg"},
          R"({"line": [0,0,900,3]})");
  refused(3, "it draws polygons", {"clip", "--algorithm", "plane", "--draw", "a.svg"},
          R"({"plane": [1,1,1,-1], "points": [[1,0,0]]})");
  const std::string values = R"({"triangle": [[0,0],[4,0],[0,4]], "width": 4, "height": 4})";
  refused(3, "--values takes one case", {"scan", "--algorithm", "edge-values", "--values", "a.csv"},
          values + "\n" + values);
  refused(3, "\"width\" is missing", {"scan", "--algorithm", "edge-values"},
          R"({"triangle": [[0,0],[4,0],[0,4]]})");
}

}  // namespace
}  // namespace fathom::test
