#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/validation_case.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

/// The XML that CI services and CTest read, read back by Python.
namespace fathom::validation {
namespace {

using attribution::PixelClass;
using testing::HasSubstr;

/// A map of one row whose pixels are of these classes, over a plane at depth 1.
ValidationCase case_of(const std::string& scene, const std::string& variant,
                       const std::vector<PixelClass>& classes) {
  auto truth = std::make_shared<attribution::Truth>();
  truth->mesh.points = {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}};
  truth->mesh.triangles = {{0, 1, 2}};
  truth->depths.assign(classes.size(), 1);
  truth->triangles.assign(classes.size(), 0);
  ValidationCase made{.scene = scene, .renderer = "vtk", .variant = variant, .version = "9.1"};
  made.truth = truth;
  made.other.width = static_cast<std::uint32_t>(classes.size());
  made.other.height = 1;
  made.other.depths.assign(classes.size(), 1.5);
  made.attribution.classes = classes;
  made.attribution.least.assign(classes.size(), 0.75F);
  made.attribution.greatest.assign(classes.size(), 1.25F);
  for (const PixelClass c : classes) ++made.attribution.counts[static_cast<std::size_t>(c)];
  return made;
}

const std::vector<PixelClass> good(4, PixelClass::equal);
const std::vector<PixelClass> bad{PixelClass::equal, PixelClass::edge, PixelClass::unexplained,
                                  PixelClass::unexplained};

/// The document as Python reads it: for each element its tag, its attributes, its text and
/// elements.
nlohmann::json parsed(const std::string& xml) {
  const test::TestFolder folder;
  folder.write("read.xml", xml);
  const test::Outcome outcome =
      test::run({test::python, "-c",
                 "import json, sys, xml.etree.ElementTree as tree\n"
                 "def told(e): return [e.tag, e.attrib, e.text or '', [told(c) for c in e]]\n"
                 "print(json.dumps(told(tree.parse(sys.argv[1]).getroot())))",
                 folder / "read.xml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err << xml;
  return nlohmann::json::parse(outcome.out);
}

TEST(Cause, IsTheFailureElseTheFirstFindingElseTheWorstPixel) {
  EXPECT_EQ(cause_of(case_of("spot", "", good)), "");
  ValidationCase c = case_of("spot", "", bad);
  c.other.depths[3] = 1.75;
  EXPECT_EQ(cause_of(c),
            "2 of 4 pixels unexplained, the worst (3, 0): 1.75 instead of 1, allowed "
            "0.75 to 1.25");
  c.other.depths[2] = c.other.depths[3] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(cause_of(c), HasSubstr("(2, 0): background instead of 1, allowed"));
  c.attribution.findings = {{"shift", "it is shifted", 3}, {"bias", "it is biased", 2}};
  EXPECT_EQ(cause_of(c), "shift: it is shifted (3 pixels)");
  c.failure = "it crashed";
  EXPECT_EQ(cause_of(c), "it crashed");
}

TEST(Cause, OnePixelIsNotPlural) {
  EXPECT_EQ(attribution::finding_line({"shift", "it is shifted", 1}),
            "shift: it is shifted (1 pixel)");
  ValidationCase c = case_of("spot", "", bad);
  c.attribution.findings = {{"shift", "it is shifted", 1}};
  EXPECT_EQ(cause_of(c), "shift: it is shifted (1 pixel)");
}

TEST(Verdict, BeginsWithTheFault) {
  ValidationCase c = case_of("spot", "own", good);
  EXPECT_EQ(verdict_of(c), "every pixel is explained");
  c.attribution.findings = {{"shift", "the image is shifted", 3}};
  EXPECT_EQ(verdict_of(c), "failed: the image is shifted (3 pixels)");
  EXPECT_THAT(verdict_of(case_of("spot", "own", bad)),
              testing::StartsWith("failed: 2 of 4 pixels unexplained, the worst "));
  c.failure = "it crashed";
  EXPECT_EQ(verdict_of(c), "not drawn: it crashed");
}

TEST(Verdict, OfSeveralMapsCountsThoseThatFailed) {
  std::vector<ValidationCase> cases{case_of("spot", "a", good), case_of("spot", "b", good)};
  EXPECT_EQ(verdict_of(cases), "every pixel of 2 maps is explained");
  cases[1].attribution.findings = {{"shift", "it is shifted", 3}};
  cases.push_back(case_of("spot", "c", {}));
  cases[2].failure = "it crashed";
  EXPECT_EQ(verdict_of(cases),
            "failed: 1 of 2 maps; 1 not drawn; the first is spot, vtk b: shift: it is shifted "
            "(3 pixels)");
  cases.erase(cases.begin(), cases.begin() + 2);
  EXPECT_EQ(verdict_of(cases), "not drawn: it crashed");
}

TEST(Junit, ABroughtMapHasAFileAndNoVersion) {
  ValidationCase c = case_of("spot", "auto", good);
  c.version.clear();
  c.file = "theirs.exr";
  const std::string xml = to_junit({c}, nullptr);
  EXPECT_THAT(xml, HasSubstr("<property name=\"map\" value=\"theirs.exr\"/>"));
  EXPECT_THAT(xml, testing::Not(HasSubstr("name=\"version\"")));
}

TEST(Junit, HasASuiteForEachSceneAndACaseForEachRenderer) {
  std::vector<ValidationCase> cases{case_of("spot", "unorm24", good), case_of("room", "own", bad),
                                    case_of("spot", "own", {})};
  cases[0].seconds = 1.25;
  cases[1].seconds = 2;
  cases[2].failure = "it crashed";
  const auto all = parsed(to_junit(cases, nullptr));
  EXPECT_EQ(all[0], "testsuites");
  EXPECT_EQ(all[1], (nlohmann::json{{"name", "fathom validate"},
                                    {"tests", "3"},
                                    {"failures", "1"},
                                    {"errors", "1"},
                                    {"time", "3.250"}}));
  const auto &spot = all[3][0], &room = all[3][1];
  EXPECT_EQ(spot[1], (nlohmann::json{{"name", "spot"},
                                     {"tests", "2"},
                                     {"failures", "0"},
                                     {"errors", "1"},
                                     {"time", "1.250"}}));
  EXPECT_EQ(spot[3][0][1], (nlohmann::json{{"classname", "fathom.validate.spot"},
                                           {"name", "vtk unorm24"},
                                           {"time", "1.250"}}));
  EXPECT_EQ(spot[3][0][3].size(), 1U) << "properties, and neither failure nor error";
  EXPECT_EQ(spot[3][0][3][0][3][1][1], (nlohmann::json{{"name", "equal pixels"}, {"value", "4"}}));
  const auto& error = spot[3][1][3][1];
  EXPECT_EQ(error[0], "error");
  EXPECT_EQ(error[1], (nlohmann::json{{"message", "it crashed"}, {"type", "not drawn"}}));
  EXPECT_FALSE(spot[3][1][1].contains("time")) << "it was not measured";
  const auto& failure = room[3][0][3][1];
  EXPECT_EQ(failure[0], "failure");
  EXPECT_EQ(failure[1]["message"], "failed: " + cause_of(cases[1]));
  EXPECT_EQ(failure[1]["type"], "unexplained");
  EXPECT_THAT(failure[2].get<std::string>(), HasSubstr("unexplained (2, 0): 1.5 instead of 1"));
}

/// What JUnit and report.json say of z-fighting.
void expect_z_fighting(const ValidationCase& c, const std::string& property,
                       const nlohmann::json& pixels) {
  const std::string junit = to_junit({c}, nullptr), json = to_json({c});
  EXPECT_THAT(junit, HasSubstr("name=\"z-fight pixels\" value=\"" + property + "\""));
  EXPECT_EQ(nlohmann::json::parse(json)["results"][0]["z_fighting"]["pixels"], pixels);
}

// A wrong surface with the right depth cannot be seen without numbers of triangles: 0 would be a
// guess.
TEST(ZFighting, IsUnknownWithoutTriangleNumbers) {
  ValidationCase c = case_of("spot", "own peeled", good);
  expect_z_fighting(c, "unknown: no triangle numbers were read", nullptr);
  EXPECT_EQ(z_fight_clause(c), "z-fight unknown (no triangle numbers)");
  c = case_of("spot", "own peeled", {PixelClass::z_fight, PixelClass::equal});
  expect_z_fighting(c, "at least 1: no triangle numbers were read", nullptr);
  EXPECT_EQ(z_fight_clause(c), "at least 1 z-fight (no triangle numbers)");
}

TEST(ZFighting, IsCountedWithTriangleNumbersAndPredicted) {
  ValidationCase c = case_of("spot", "unorm24", good);
  c.other.triangles.assign(4, 0);
  expect_z_fighting(c, "0", 0);
  EXPECT_EQ(z_fight_clause(c), "");
  c.predicted_fights = 3;
  EXPECT_EQ(z_fight_clause(c), "0 z-fight (3 by the format alone)");
  EXPECT_THAT(to_junit({c}, nullptr),
              HasSubstr("name=\"z-fight pixels by the format alone\" value=\"3\""));
  EXPECT_EQ(nlohmann::json::parse(to_json({c}))["results"][0]["z_fighting"]["by_format_alone"], 3);
}

TEST(Junit, WhatIsWorseThanTheBaselineFails) {
  const std::vector<ValidationCase> cases{case_of("spot", "a", good), case_of("spot", "b", good)};
  Comparison comparison;
  comparison.changes.resize(2);
  comparison.changes[0].verdict = Verdict::worse;
  comparison.changes[0].worse = {"4 equal pixels, 5 in the baseline"};
  comparison.changes[1].verdict = Verdict::incomparable;
  comparison.changes[1].obstacle = "another size";
  const auto suite = parsed(to_junit(cases, &comparison))[3][0];
  EXPECT_EQ(suite[3][0][3][1][0], "failure");
  EXPECT_EQ(suite[3][0][3][1][1]["message"],
            "worse than the baseline: 4 equal pixels, 5 in the baseline");
  EXPECT_EQ(suite[3][1][3][1][0], "error");
  EXPECT_EQ(suite[3][1][3][1][1]["message"], "another size");
}

TEST(Junit, TextsThatAreNotOursStayTexts) {
  ValidationCase c = case_of("a<b>&\"'", "]]>\x01\x1b[31m", bad);
  c.version = std::string("tab\tline\nnul") + '\0' + "\xff\xef\xbf\xbf\xc2\x85 ünï";
  c.attribution.findings = {{"shift", "<![CDATA[ & \x08 \xed\xa0\x80", 1}};
  const auto test_case = parsed(to_junit({c}, nullptr))[3][0][3][0];
  EXPECT_EQ(test_case[1]["classname"], "fathom.validate.a<b>&\"'");
  EXPECT_EQ(test_case[1]["name"], "vtk ]]>??[31m");
  EXPECT_EQ(test_case[3][0][3][0][1]["value"], "tab\tline\nnul?\ufffd\ufffd? ünï");
  EXPECT_THAT(test_case[3][1][1]["message"].get<std::string>(),
              HasSubstr("failed: <![CDATA[ & ? \ufffd"));
}

/// Every byte and every pair of bytes that begins like a character makes a document that is read.
TEST(XmlText, CanAlwaysStandInADocument) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) {
    all += static_cast<char>(byte);
    all += 'a';
  }
  all += "\xef\xbf\xbe\xef\xbf\xbf\xf4\x8f\xbf\xbf\xed\xbf\xbf\xe2\x80\xa8";
  ValidationCase c = case_of(all, all, bad);
  c.version = all;
  c.attribution.findings = {{"shift", all, 1}};
  EXPECT_EQ(parsed(to_junit({c}, nullptr))[0], "testsuites");
  EXPECT_EQ(xml_text("a\tb\n\x7f"), "a&#9;b&#10;?");
}

TEST(CtestLines, HoldTheCauseTheCountsAndThePictures) {
  const ValidationCase c = case_of("spot", "", bad);
  const std::string lines = to_ctest_lines(
      c, "<1> & more", {.classes = "/tmp/a&b/classes.png", .differences = "/tmp/differences.png"});
  const auto all = parsed("<all>" + lines + "</all>")[3];
  EXPECT_EQ(all[0][0], "CTestDetails");
  EXPECT_EQ(all[0][2], "<1> & more");
  EXPECT_EQ(all[1][0], "CTestMeasurement");
  EXPECT_EQ(all[1][1], (nlohmann::json{{"type", "numeric/double"}, {"name", "equal pixels"}}));
  EXPECT_EQ(all[8][1]["name"], "unexplained pixels");
  EXPECT_EQ(all[8][2], "2");
  const auto& picture = all[all.size() - 2];
  EXPECT_EQ(picture[0], "CTestMeasurementFile");
  EXPECT_EQ(picture[1]["type"], "image/png");
  EXPECT_EQ(picture[2], "/tmp/a&b/classes.png");
  EXPECT_EQ(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')), all.size())
      << "an element in each line";
  EXPECT_THAT(to_ctest_lines(c, "", {"a", "b"}), testing::Not(HasSubstr("CTestDetails")));
}

}  // namespace
}  // namespace fathom::validation
