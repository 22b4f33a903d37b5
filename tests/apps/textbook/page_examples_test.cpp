// The examples of docs/scan.md, of docs/clipping.md and of `fathom scan --help`, run as a reader
// would.

#include "tests/apps/textbook/page_examples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

std::string without_line_ends(std::string text) {
  std::erase(text, '\n');
  return text;
}

/// Runs the examples of a page in one folder, since some read what others wrote. Every algorithm
/// has one.
void expect_true_examples(const std::filesystem::path& path, std::size_t least,
                          const std::vector<std::string>& algorithms) {
  const TestFolder folder;
  std::ifstream page(path);
  const std::vector<Example> examples = examples_of(page);
  EXPECT_GE(examples.size(), least);
  std::string commands;
  for (const auto& [command, printed] : examples) {
    const Outcome outcome = run_in_shell(command, folder.path());
    const bool differs = printed.find("\"difference\":{") != std::string::npos;
    EXPECT_EQ(outcome.status, differs ? 1 : 0) << command;
    EXPECT_EQ(without_line_ends(outcome.out + outcome.err), printed) << command;
    commands += command + "\n";
  }
  for (const std::string& algorithm : algorithms)
    EXPECT_THAT(commands, ::testing::HasSubstr("--algorithm " + algorithm));
}

TEST(ScanPage, ItsExamplesPrintWhatItSays) {
  expect_true_examples(source_dir() / "docs/scan.md", 25,
                       {"explicit", "dda", "bresenham", "midpoint", "diamond-exit", "line-forms",
                        "even-odd", "non-zero", "flood", "edge-function", "scan-line", "inside",
                        "convexity", "tessellate", "convex-hull"});
}

TEST(ClippingPage, ItsExamplesPrintWhatItSays) {
  expect_true_examples(
      source_dir() / "docs/clipping.md", 13,
      {"cohen-sutherland", "weiler-atherton", "sutherland-hodgman", "plane", "homogeneous"});
}

TEST(PipelinePage, ItsExamplesPrintWhatItSays) {
  expect_true_examples(source_dir() / "docs/pipeline.md", 1, {});
}

TEST(ScanPage, TheExamplesOfTheHelpRun) {
  std::istringstream help(run_fathom({"scan", "--help"}).out);
  std::string line, command;
  while (std::getline(help, line) && line != "Examples:") {
  }
  const TestFolder folder;
  int examples = 0;
  while (std::getline(help, line) && !line.empty()) {
    command += line;
    if (command.ends_with("|")) continue;
    const Outcome outcome = run_in_shell(command, folder.path());
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    EXPECT_FALSE(outcome.out.empty()) << command;
    command.clear();
    ++examples;
  }
  EXPECT_GE(examples, 8);
}

}  // namespace
}  // namespace fathom::test
