#include "apps/validate/report/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/reported_result.h"
#include "fathom/failures/errors.h"
#include "tests/apps/test_folder.h"

/// What changed between two reports, from report.json files to verdicts.
namespace fathom::validation {
namespace {

using attribution::PixelClass;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr auto equal = static_cast<std::size_t>(PixelClass::equal),
               edge = static_cast<std::size_t>(PixelClass::edge),
               missed = static_cast<std::size_t>(PixelClass::missed),
               unexplained = static_cast<std::size_t>(PixelClass::unexplained);

ReportedResult result(const std::string& scene, const std::string& variant) {
  ReportedResult r{.scene = scene, .renderer = "vtk", .variant = variant, .version = "9.1"};
  r.width = 10;
  r.height = 10;
  r.triangles = 12;
  r.counts[equal] = 90;
  r.counts[edge] = 10;
  return r;
}

/// The one change between two reports of one result.
ResultChange change(const ReportedResult& before, const ReportedResult& after) {
  return compare({"1", {before}}, {"2", {after}}).changes.at(0);
}

ReportedResult with_finding(const std::string& kind) {
  ReportedResult r = result("spot", "unorm24");
  r.findings = {{kind, "what was found", 5}};
  return r;
}

TEST(Comparison, MoreUnexplainedOrMissedPixelsAndFewerEqualOnesAreWorse) {
  const ReportedResult before = result("spot", "unorm24");
  EXPECT_EQ(change(before, before).verdict, Verdict::same);
  for (const std::size_t k : {unexplained, missed}) {
    ReportedResult after = before;
    after.counts[k] = 1;
    EXPECT_EQ(change(before, after).verdict, Verdict::worse);
    EXPECT_EQ(change(after, before).verdict, Verdict::better);
  }
  ReportedResult after = before;
  after.counts[equal] = 89;
  after.counts[edge] = 11;
  EXPECT_THAT(change(before, after).worse, ElementsAre("89 equal pixels, 90 in the baseline"));
  EXPECT_EQ(change(after, before).verdict, Verdict::better);
  after.counts[unexplained] = 0;
  after.counts[equal] = 95;
  after.counts[missed] = 1;
  EXPECT_EQ(change(before, after).verdict, Verdict::worse) << "better does not make up for worse";
}

TEST(Comparison, OnePixelAndOneTriangleAreNotPlural) {
  const ReportedResult before = result("spot", "unorm24");
  ReportedResult after = before;
  after.counts[missed] = 1;
  EXPECT_THAT(change(before, after).worse,
              ElementsAre("1 missed surface pixel, 0 in the baseline"));
  after.triangles = 1;
  EXPECT_EQ(change(after, before).obstacle, "a scene of 1 triangle in the baseline, of 12 now");
}

TEST(Comparison, OtherCountsAndErrorsAreAChangeAndVersionsAreNot) {
  const ReportedResult before = result("spot", "unorm24");
  ReportedResult after = before;
  after.version = "9.2";
  EXPECT_EQ(change(before, after).verdict, Verdict::same);
  after.greatest_error = 1e-7;
  EXPECT_EQ(change(before, after).verdict, Verdict::changed);
}

TEST(Comparison, FindingsAreComparedByTheirKindAndComeFirst) {
  const ReportedResult clean = result("spot", "unorm24");
  ReportedResult after = with_finding("shift");
  after.counts[equal] = 80;
  const ResultChange worse = change(clean, after);
  EXPECT_THAT(worse.worse, ElementsAre("what was found", "80 equal pixels, 90 in the baseline"));
  EXPECT_EQ(change(with_finding("shift"), clean).verdict, Verdict::better);
  EXPECT_EQ(change(with_finding("shift"), with_finding("shift")).verdict, Verdict::same);
  EXPECT_EQ(change(with_finding("shift"), with_finding("bias")).verdict, Verdict::worse);
}

TEST(Comparison, WhatIsNotDrawnAnyMoreIsWorseAndWhatIsDrawnAgainBetter) {
  const ReportedResult drawn = result("spot", "unorm24");
  const ReportedResult absent{
      .scene = "spot", .renderer = "vtk", .variant = "unorm24", .failure = "crashed"};
  EXPECT_THAT(change(drawn, absent).worse, ElementsAre("was drawn in the baseline; now: crashed"));
  EXPECT_EQ(change(absent, drawn).verdict, Verdict::better);
  EXPECT_EQ(change(absent, absent).verdict, Verdict::same);
}

TEST(Comparison, ResultsOfOneRunAreNewOrGone) {
  const Report before{"1", {result("spot", "a"), result("spot", "b")}};
  const Report after{"2", {result("spot", "b"), result("spot", "c")}};
  const Comparison both = compare(before, after);
  ASSERT_EQ(both.changes.size(), 3U);
  EXPECT_EQ(both.changes[0].verdict, Verdict::same);
  EXPECT_EQ(both.changes[1].verdict, Verdict::appeared);
  EXPECT_EQ(both.changes[2].verdict, Verdict::gone);
  EXPECT_EQ(both.obstacle(), "");
  EXPECT_EQ(both.regression(), "");
  EXPECT_EQ(lines_of(both),
            "not in the baseline: spot, vtk c\nonly in the baseline: spot, vtk a\n"
            "baseline: 0 worse, 0 better, 0 changed, 1 same, 1 new, 1 gone, 0 not comparable\n");
}

TEST(Comparison, CountsOfOtherSizesOrScenesAreNotCompared) {
  const ReportedResult before = result("spot", "a");
  ReportedResult larger = before, another = before;
  larger.width = 20;
  larger.counts[unexplained] = 3;
  another.triangles = 13;
  EXPECT_EQ(change(before, larger).verdict, Verdict::incomparable);
  EXPECT_EQ(compare({"1", {before}}, {"1", {larger}}).obstacle(),
            "spot, vtk a: 10x10 pixels in the baseline, 20x10 now");
  EXPECT_THAT(change(before, another).obstacle, HasSubstr("12 triangles"));
  EXPECT_EQ(compare({"1", {before}}, {"1", {result("spot", "b")}}).obstacle(),
            "contains no result of this run");
}

TEST(Comparison, ManyThatAreNewAreCounted) {
  Report after{"2", {}};
  for (int k = 0; k < 20; ++k) after.results.push_back(result("spot", std::to_string(k)));
  const std::string lines = lines_of(compare({"1", {after.results[0]}}, after));
  EXPECT_THAT(lines, HasSubstr("not in the baseline: spot, vtk 8\nnot in the baseline: 11 more\n"));
}

/// Names and texts of a report are not ours: nothing in them ends the page's data.
TEST(Comparison, APageHoldsTextsThatLookLikeMarkup) {
  ReportedResult after = with_finding("shift");
  after.findings[0].text = "</script><b>";
  const std::string page = to_html(compare({"1", {}}, {"2", {after}}));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
  EXPECT_THAT(page, testing::Not(HasSubstr("</script><b>")));
}

nlohmann::json report_json() {
  nlohmann::json pixels{
      {"equal", 90},  {"within quantization", 0}, {"within arithmetic", 0}, {"edge", 10},
      {"z-fight", 0}, {"missed surface", 0},      {"convention", 0},        {"unexplained", 0}};
  nlohmann::json done{{"scene", "spot"},
                      {"renderer", "vtk"},
                      {"variant", "unorm24"},
                      {"version", "9.1"},
                      {"width", 10},
                      {"height", 10},
                      {"triangles", 12},
                      {"pixels", pixels},
                      {"bounds", {{"median_relative_width", nullptr}}},
                      {"errors", {{"median_relative", 1e-8}, {"greatest_relative", 1e-7}}},
                      {"findings", {{{"kind", "bias"}, {"text", "biased"}, {"pixels", 7}}}}};
  nlohmann::json absent{{"scene", "spot"},
                        {"renderer", "vtk"},
                        {"variant", "own"},
                        {"version", ""},
                        {"failure", "crashed"}};
  return {{"fathom", "0.1.0"}, {"results", {done, absent}}};
}

class ReadReport : public testing::Test {
 protected:
  Report read(const std::string& text) {
    folder.write("report.json", text);
    return read_report(folder / "report.json");
  }
  /// The message without the folder.
  std::string refusal(const std::string& text) {
    try {
      read(text);
      return "";
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder.path().string().size() + 1);
    }
  }

  const test::TestFolder folder;
};

TEST_F(ReadReport, ReadsWhatIsCompared) {
  const Report report = read(report_json().dump());
  EXPECT_EQ(report.fathom, "0.1.0");
  ASSERT_EQ(report.results.size(), 2U);
  EXPECT_EQ(title_of(report.results[0]), "spot, vtk unorm24");
  EXPECT_EQ(report.results[0].counts[edge], 10U);
  EXPECT_EQ(report.results[0].triangles, 12U);
  EXPECT_EQ(report.results[0].greatest_error, 1e-7);
  EXPECT_EQ(report.results[0].findings.at(0).pixels, 7U);
  EXPECT_EQ(report.results[1].failure, "crashed");
}

TEST_F(ReadReport, SaysWhatToDoAboutOthers) {
  const std::string whole = report_json().dump(2),
                    remedy = "; write it again: fathom validate … -o DIR";
  for (const std::size_t length : {std::size_t{0}, whole.size() / 3, whole.size() - 2}) {
    EXPECT_EQ(refusal(whole.substr(0, length)),
              "report.json: is cut off: it ends within its JSON" + remedy)
        << length;
  }
  nlohmann::json other = report_json();
  other["format"] = 2;
  EXPECT_EQ(
      refusal(other.dump()),
      "report.json: is a report of layout 2, by Fathom 0.1.0, and this Fathom (" FATHOM_VERSION
      ") reads layout 1" +
          remedy);
  other = report_json();
  other["results"][0].erase("triangles");
  EXPECT_THAT(refusal(other.dump()), HasSubstr("is not a report.json of fathom validate: "));
  EXPECT_THAT(refusal("[1]"), HasSubstr("is not a report.json of fathom validate: "));
  EXPECT_THAT(refusal("<html>"), HasSubstr("is not a report.json of fathom validate: "));
  for (const std::string& text : {whole + "}", other.dump(), std::string("{}")}) {
    EXPECT_THAT(refusal(text), HasSubstr(remedy));
  }
}

}  // namespace
}  // namespace fathom::validation
