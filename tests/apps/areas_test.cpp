// `areas`: files of lights, the rows of its tables, and what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/surfaces/area_table.h"
#include "apps/surfaces/light_list.h"
#include "fathom/failures/errors.h"
#include "run_program.h"
#include "test_folder.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom::app {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using Numbers = std::array<double, 3>;

constexpr auto directions = LightList::Kind::directions;
constexpr auto points = LightList::Kind::points;

class Lights : public ::testing::Test {
 protected:
  LightList read(std::string_view text, LightList::Kind kind = directions) const {
    return read_lights(folder_.write("suns.csv", text), kind);
  }
  /// The message without the name of the file.
  std::string refusal(std::string_view text, LightList::Kind kind = directions) const {
    const std::string message = message_of<InputError>([&] { read(text, kind); });
    const std::string file = (folder_.path() / "suns.csv").string() + ": ";
    return message.starts_with(file) ? message.substr(file.size()) : message;
  }

  ScratchFolder folder_;
};

TEST_F(Lights, HaveColumnsInAnyOrder) {
  const LightList list = read("name,z,x,y,weight\nnoon,3,1,2,0.5\n\n  late , 6,4 ,5e0,\n");
  EXPECT_THAT(list.headings, ElementsAre("name", "weight"));
  ASSERT_EQ(list.lights.size(), 2U);
  EXPECT_EQ(list.lights[0].numbers, (Numbers{1, 2, 3}));
  EXPECT_EQ(list.lights[1].numbers, (Numbers{4, 5, 6}));
  EXPECT_EQ(list.lights[0].line, 2);
  EXPECT_EQ(list.lights[1].line, 4);
  EXPECT_THAT(list.lights[0].fields, ElementsAre("noon", "0.5"));
  EXPECT_THAT(list.lights[1].fields, ElementsAre("late", ""));
}

TEST_F(Lights, MayHaveQuotes) {
  const LightList list = read(
      "\"x\",\"y\",\"z\",\"a, b\"\n\"1\",2,\"3\",\"he said \"\"noon\"\", twice\"\n4,5,6, \" \" \n");
  EXPECT_THAT(list.headings, ElementsAre("a, b"));
  EXPECT_EQ(list.lights[0].numbers, (Numbers{1, 2, 3}));
  EXPECT_THAT(list.lights[0].fields, ElementsAre("he said \"noon\", twice"));
  EXPECT_THAT(list.lights[1].fields, ElementsAre(" "));
  EXPECT_EQ(refusal("x,y,z\n1,2,\"3\n"), "line 2: a quote is not closed");
  EXPECT_EQ(refusal("x,y,z\n1,\"2\"3,4\n"), "line 2: expected a comma behind a quote");
}

// As spreadsheets write them.
TEST_F(Lights, MayHaveCarriageReturnsAndAMark) {
  for (const char* text : {"\xEF\xBB\xBFx,y,z,\"name\"\r\n1,2,3,\"noon\"\r\n4,5,6,late\r\n",
                           "x,y,z,name\r1,2,3,noon\r4,5,6,\"late\""}) {
    const LightList list = read(text);
    EXPECT_THAT(list.headings, ElementsAre("name"));
    ASSERT_EQ(list.lights.size(), 2U);
    EXPECT_EQ(list.lights[1].numbers, (Numbers{4, 5, 6}));
    EXPECT_THAT(list.lights[0].fields, ElementsAre("noon"));
    EXPECT_THAT(list.lights[1].fields, ElementsAre("late"));
  }
}

TEST_F(Lights, NeedTheirColumnsOnce) {
  EXPECT_EQ(refusal("x,y\n1,2\n"),
            "line 1: expected a heading with the columns x, y and z, or azimuth and elevation");
  EXPECT_EQ(refusal("azimuth,elevation\n1,2\n", points),
            "line 1: expected a heading with the columns x, y and z");
  EXPECT_EQ(refusal("1,2,3\n"),
            "line 1: expected a heading with the columns x, y and z, or azimuth and elevation");
  EXPECT_EQ(refusal("x,y,z,x\n1,2,3,4\n"), "line 1: the column 'x' is there twice");
  EXPECT_EQ(refusal("x,note,y,z,note\n1,a,2,3,b\n"), "line 1: the column 'note' is there twice");
  EXPECT_EQ(refusal("x,y,z\n1,2\n"), "line 2: expected 3 fields, found 2");
  EXPECT_EQ(refusal("x,y,z\n1,2,3,4\n"), "line 2: expected 3 fields, found 4");
  EXPECT_EQ(refusal(""), "is empty");
  EXPECT_EQ(refusal("x,y,z\n"), "has a heading and no line");
}

TEST_F(Lights, AreFiniteNumbersAndNoDirectionIsZero) {
  for (const char* number : {"nan", "inf", "1e999", "1.5m", "", "0x10"}) {
    EXPECT_EQ(refusal(std::string("x,y,z\n1,2,3\n1,") + number + ",3\n"),
              std::string("line 3: expected a finite number, found '") + number + "'");
  }
  EXPECT_EQ(refusal("x,y,z\n1,2,3\n\n0,-0,0\n"), "line 4: the direction is 0");
  EXPECT_EQ(read("x,y,z\n0,0,0\n", points).lights[0].numbers, (Numbers{0, 0, 0}));
}

TEST_F(Lights, MayHaveAnAzimuthAndAnElevation) {
  const LightList list = read("azimuth,elevation,day\n90,0,1\n180,30,2\n");
  EXPECT_THAT(list.headings, ElementsAre("azimuth", "elevation", "day"));
  EXPECT_EQ(list.lights[0].numbers, (Numbers{1, 0, 0}));
  EXPECT_EQ(list.lights[1].numbers[2], 0.5);
  EXPECT_LT(list.lights[1].numbers[1], 0);
  EXPECT_THAT(list.lights[1].fields, ElementsAre("180", "30", "2"));
  // x, y and z are the direction if both are there, as in tables of fathom sun.
  const LightList both = read("azimuth,elevation,x,y,z\n90,0,1,2,3\n");
  EXPECT_EQ(both.lights[0].numbers, (Numbers{1, 2, 3}));
  EXPECT_THAT(both.headings, ElementsAre("azimuth", "elevation"));
  EXPECT_EQ(refusal("azimuth,elevation\n0,91\n"),
            "line 2: the elevation must be between -90 and 90 degrees");
  for (const char* azimuth : {"360.5", "-361", "1e300"}) {
    EXPECT_EQ(refusal(std::string("azimuth,elevation\n-360,0\n") + azimuth + ",0\n"),
              "line 3: the azimuth must be between -360 and 360 degrees");
  }
}

TEST(AreaTableFormat, IsThatOfTheSuffix) {
  EXPECT_EQ(table_format_of("a.csv", false), TableFormat::csv);
  EXPECT_EQ(table_format_of("a.JSON", false), TableFormat::json);
  EXPECT_EQ(table_format_of("a.json", true), TableFormat::json);
  EXPECT_EQ(table_format_of("-", false), TableFormat::csv);
  EXPECT_EQ(table_format_of("-", true), TableFormat::json);
  EXPECT_EQ(table_format_of("folder.d/areas", true), TableFormat::json);
  EXPECT_THROW(table_format_of("a.csv", true), UsageError);
  EXPECT_EQ(table_format_of("a.NPZ", false), TableFormat::npz);
  EXPECT_EQ(message_of<UsageError>([] { table_format_of("a.npz", true); }),
            "'a.npz' is a name of NPZ, and --json asks for JSON");
  EXPECT_EQ(message_of<UsageError>([] { table_format_of("a.txt", false); }),
            "'a.txt' does not end in .csv, .npz or .json");
}

/// Items of which one is hidden, one so small that its area is 0, and one too large.
struct Example {
  static LitArea of(double lit, const std::optional<Numbers>& centroid) {
    LitArea area;
    area.lit = lit;
    area.centroid = centroid;
    return area;
  }

  AreaItems items{{{0, "hidden", {}, {}}, {1, "small", {}, {}}, {2, "large", {}, {}}}, {}};
  std::vector<LitArea> areas{
      of(0, std::nullopt), of(0, std::array{1.0, 2.0, 3.0}),
      of(std::numeric_limits<double>::infinity(), std::array{0.0, 0.0, 0.0})};
  LightList lights{"suns.csv", {"name", "light_name"}, {{{1, 0, 0}, {"noon", "other"}, 2}}};

  std::string whole(const AreaTable::Form& form) const {
    const AreaTable table(form, items, lights);
    const std::string rows = table.rows(0, areas);
    return table.beginning() + std::string(table.after(rows, true)) +
           std::string(table.after(rows, false)) + table.end();
  }
};

TEST(AreaTable, KeepsAllColumnsAndInfinities) {
  const Json rows = Json::parse(Example().whole({.format = TableFormat::json}));
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["name"], "hidden");
  EXPECT_EQ(rows[0]["light_light_name"], "noon");
  EXPECT_EQ(rows[0]["light_name"], "other");
  EXPECT_EQ(rows[5]["lit"], "inf");
  EXPECT_TRUE(rows[5]["visible"].is_null());
  EXPECT_THAT(Example().whole({}), HasSubstr("\"light_light_name\",\"light_name\"\n"));
  EXPECT_THAT(Example().whole({}), EndsWith(",inf,0,0,0,\"noon\",\"other\"\n"));
}

TEST(AreaTable, LeavesOutItemsOfWhichNothingIsVisible) {
  const Json rows = Json::parse(Example().whole({.format = TableFormat::json, .nonzero = true}));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["name"], "small");
  EXPECT_EQ(rows[1]["name"], "large");
}

TEST(AreaTable, OfNoRowsIsAList) {
  Example none;
  none.areas.clear();
  EXPECT_EQ(Json::parse(none.whole({.format = TableFormat::json})), Json::array());
}

class AreasCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("suns.csv", "x,y,z\n1,-1,0\n0,0,1\n");
    folder_.write("zero.csv", "x,y,z\n1,-1,0\n0,0,0\n");
  }
  test::Outcome areas(std::vector<std::string> more) const {
    more.insert(more.begin(), {"areas", test::source_dir() / "data/meshes/cube.obj"});
    return test::run_fathom(more, {.folder = folder_.path()});
  }
  std::string refusal(const std::vector<std::string>& more, int status) const {
    const test::Outcome outcome = areas(more);
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  }

  test::TestFolder folder_;
};

TEST_F(AreasCommand, WritesTheSameToAFileAsToStandardOutput) {
  std::string many = "x,y,z\n";
  for (int k = 0; k < 150; ++k) many += std::to_string(k) + ",1,2\n";
  folder_.write("many.csv", many);
  for (const std::string form : {"csv", "json"}) {
    const test::Outcome written =
        areas({"--directions", "many.csv", "--by", "face", "-o", "areas." + form});
    EXPECT_EQ(written.status, 0) << written.err;
    std::vector<std::string> printing{"--directions", "many.csv", "--by", "face", "--threads", "1"};
    if (form == "json") printing.push_back("--json");
    EXPECT_EQ(areas(printing).out, folder_.read("areas." + form));
  }
  const Json rows = Json::parse(folder_.read("areas.json"));
  ASSERT_EQ(rows.size() % 150, 0U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k]["direction"], k / (rows.size() / 150));
  }
}

TEST_F(AreasCommand, RefusesOptionsWithoutEffect) {
  EXPECT_THAT(refusal({"--directions", "suns.csv", "--fov", "30"}, 2),
              HasSubstr("--fov is for a camera, not for --directions"));
  EXPECT_THAT(refusal({"--points", "suns.csv", "--scale", "0.5"}, 2),
              HasSubstr("--scale is for a camera, not for --points"));
  EXPECT_THAT(refusal({"--points", "suns.csv", "--centroid", "across"}, 2),
              HasSubstr("--centroid across is for --directions"));
  EXPECT_THAT(refusal({"--centroid", "across"}, 2),
              HasSubstr("--centroid across is for --directions"));
  EXPECT_THAT(refusal({"--directions", "suns.csv", "--stream"}, 2),
              HasSubstr("areas need the whole scene in memory"));
  EXPECT_THAT(refusal({"--directions", "suns.csv", "-o", "a.txt"}, 2),
              HasSubstr("'a.txt' does not end in .csv, .npz or .json"));
  EXPECT_THAT(refusal({"--directions", "suns.csv", "--nonzero", "-o", "a.npz"}, 2),
              HasSubstr("--nonzero is for CSV and JSON"));
  EXPECT_THAT(refusal({"--points", "suns.csv", "--alone"}, 2),
              HasSubstr("--alone is for --directions and cameras"));
  EXPECT_THAT(refusal({"--directions", "suns.csv", "--alone", "--by", "triangle"}, 2),
              HasSubstr("--alone is for groups of triangles"));
  EXPECT_EQ(areas({"--points", "suns.csv", "--centroid", "lit"}).status, 0);
  EXPECT_THAT(test::run_fathom({"areas", "--help"}).out, ::testing::Not(HasSubstr("--stream")));
}

TEST_F(AreasCommand, WarnsOfATableWithoutRows) {
  const test::Outcome outcome = areas({"--directions", "suns.csv", "--by", "material"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("the scene has no material: the table has no rows"));
  EXPECT_EQ(areas({"--directions", "suns.csv", "--by", "face"}).err, "");
}

TEST_F(AreasCommand, RefusesDirectionsWithTheirLine) {
  EXPECT_EQ(refusal({"--directions", "zero.csv"}, 3),
            "fathom: error: zero.csv: line 3: the direction is 0\n");
  // Nothing of the first line's answer is left.
  folder_.write("far.csv", "x,y,z\n1,-1,0\n1,1e301,1e-301\n");
  folder_.write("large.obj", "v 0 0 0\nv 1e60 0 0\nv 0 1 1\nf 1 2 3\n");
  const test::Outcome outcome =
      test::run_fathom({"areas", "large.obj", "--directions", "far.csv", "-o", "areas.csv"},
                       {.folder = folder_.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("far.csv: line 3: direction: its numbers and those of the "
                                     "scene differ too much in size"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "areas.csv"));
}

}  // namespace
}  // namespace fathom::app
