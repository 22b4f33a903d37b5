// fathom study: the files of a study, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class StudyTest : public ::testing::Test {
 protected:
  Outcome study(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "study");
    RunOptions options;
    options.folder = folder.path();
    return run_fathom(arguments, options);
  }
  TestFolder folder;
};

TEST_F(StudyTest, ListNamesThem) {
  const Outcome outcome = study({"--list"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("depth-resolution"));
  EXPECT_THAT(outcome.out, HasSubstr("indistinguishable"));
}

TEST_F(StudyTest, EveryPlotOfThePageIsThere) {
  for (const std::string name : {"depth-resolution", "indistinguishable", "z-fighting"}) {
    const Outcome outcome = study({name, "--samples", "33", "--near", "1", "--out", name});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const std::filesystem::path out = folder.path() / name;
    const std::string page = content_of(out / "index.html");
    std::size_t plots = 0;
    for (std::size_t at = page.find("<img src=\""); at != std::string::npos;
         at = page.find("<img src=\"", at + 1), ++plots) {
      const std::size_t begin = at + 10;
      const std::string png = page.substr(begin, page.find('"', begin) - begin);
      EXPECT_THAT(content_of(out / png), StartsWith("\x89PNG")) << png;
      const std::string base = png.substr(0, png.size() - 4);
      EXPECT_THAT(content_of(out / (base + ".svg")), HasSubstr("</svg>")) << base;
    }
    EXPECT_GE(plots, 6U);
    const auto summary = nlohmann::json::parse(content_of(out / "summary.json"));
    EXPECT_EQ(summary["study"], name);
    EXPECT_EQ(summary["samples"], 33);
    EXPECT_EQ(summary["near"], 1);
  }
}

TEST_F(StudyTest, TheFiguresAreThoseOfTheCalculator) {
  ASSERT_EQ(study({"depth-resolution", "--samples", "3", "--near", "1", "--far", "4", "--out", "x"})
                .status,
            0);
  const std::string csv = content_of(folder.path() / "x" / "steps.csv");
  const std::string step = run_fathom({"depth", "resolution", "--mapping", "log", "--storage",
                                       "unorm16", "--near", "1", "--far", "4", "2"})
                               .out;
  EXPECT_THAT(csv, HasSubstr("\nlog,unorm16,1,4,2," + step.substr(0, step.size() - 1) + ","));
}

TEST_F(StudyTest, WhatCannotBeMeantIsRefused) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& said) {
    const Outcome outcome = study(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, StartsWith("fathom: error: "));
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  };
  refused({}, "--list");
  refused({"course", "--list"}, "leave out NAME");
  refused({"--list", "--out", "out"}, "leave out NAME");
  refused({"depth-resolution"}, "-o DIR is missing");
  refused({"resolution", "--out", "out"}, "indistinguishable");
  refused({"z-fighting", "--separation", "0", "--out", "out"}, "--separation");
  refused({"z-fighting", "--near", "1", "--far", "2", "--out", "out"}, "8 times near");
  refused({"depth-resolution", "--near", "0", "--out", "out"}, "near = 0");
  refused({"depth-resolution", "--near", "2", "--far", "1", "--out", "out"}, "far = 1");
  refused({"depth-resolution", "--far", "inf", "--out", "out"}, "'inf'");
  refused({"depth-resolution", "--samples", "1", "--out", "out"}, "--samples");
  refused({"depth-resolution", "--samples", "4000000000", "--out", "out"}, "--samples");
  refused({"indistinguishable", "--near", "1e-30", "--out", "out"}, "1e-15");
  refused({"mitigation", "--near", "-1", "--out", "out"}, "near = -1");
  refused({"mitigation", "--samples", "5", "--out", "out"}, "no --separation and no --samples");
  refused({"lens", "--near", "1", "--out", "out"}, "the study lens has no --near");
  refused({"clipping", "--samples", "4000000000", "--out", "out"}, "--samples");
  refused({"depth-resolution", "--scene", "a.obj", "--out", "out"}, "takes no --scene");
  refused({"z-fighting", "--camera", "a.json", "--out", "out"}, "belongs to --scene");
}

TEST_F(StudyTest, WithoutGnuplotItSaysSoBeforeTheWork) {
  RunOptions options;
  options.folder = folder.path();
  const Outcome outcome = run({"/usr/bin/env", "PATH=/nowhere", program_path(), "study",
                               "indistinguishable", "--out", "out"},
                              options);
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("gnuplot-nox"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(StudyTest, WithoutPlotsItNeedsNoGnuplot) {
  RunOptions options;
  options.folder = folder.path();
  const Outcome outcome = run({"/usr/bin/env", "PATH=/nowhere", program_path(), "study",
                               "depth-resolution", "--samples", "3", "--no-plots", "--out", "out"},
                              options);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(content_of(folder.path() / "out/index.html"), HasSubstr("<table"));
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "out")) {
    EXPECT_THAT(file.path().extension().string(), AnyOf(".csv", ".json", ".html"));
  }
}

TEST_F(StudyTest, AFileInTheWayIsAnErrorOfWriting) {
  std::ofstream(folder.path() / "out") << "mine";
  const Outcome outcome = study({"depth-resolution", "--samples", "2", "--out", "out"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(content_of(folder.path() / "out"), "mine");
}

}  // namespace
}  // namespace fathom::test
