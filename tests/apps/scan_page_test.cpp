// The examples of docs/scan.md and of `fathom scan --help`, run as a reader would.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "run_program.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

/// A command line of a shell and what the page says that it prints, without line breaks.
struct Example {
  std::string command, printed;
};

std::string without_indent(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

/// Of a fenced block: each line that begins with "$ ", and the lines that follow it.
std::vector<Example> examples_of(std::istream& page) {
  std::vector<Example> examples;
  bool fenced = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      fenced = !fenced;
    } else if (fenced && line.starts_with("$ ")) {
      examples.push_back({line.substr(2), ""});
    } else if (fenced && !examples.empty()) {
      examples.back().printed += without_indent(line);
    }
  }
  return examples;
}

Outcome run_in_shell(const std::string& command) {
  const std::string folder = std::filesystem::path(program_path()).parent_path();
  return run({"/bin/bash", "-c", "PATH=$0:$PATH; " + command, folder});
}

TEST(ScanPage, ItsExamplesPrintWhatItSays) {
  std::ifstream page(source_dir() / "docs/scan.md");
  const std::vector<Example> examples = examples_of(page);
  EXPECT_GE(examples.size(), 25u);
  std::string commands;
  for (const auto& [command, printed] : examples) {
    const Outcome outcome = run_in_shell(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, printed + "\n") << command;
    commands += command + "\n";
  }
  // Every algorithm has one.
  for (const std::string algorithm :
       {"explicit", "dda", "bresenham", "midpoint", "diamond-exit", "line-forms", "even-odd",
        "non-zero", "flood", "edge-function", "scan-line", "inside", "convexity", "tessellate",
        "convex-hull"})
    EXPECT_THAT(commands, ::testing::HasSubstr("--algorithm " + algorithm));
}

TEST(ScanPage, TheExamplesOfTheHelpRun) {
  std::istringstream help(run_fathom({"scan", "--help"}).out);
  std::string line, command;
  while (std::getline(help, line) && line != "Examples:") {
  }
  int examples = 0;
  while (std::getline(help, line) && !line.empty()) {
    command += line;
    if (command.ends_with("|")) continue;
    const Outcome outcome = run_in_shell(command);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    EXPECT_FALSE(outcome.out.empty()) << command;
    command.clear();
    ++examples;
  }
  EXPECT_GE(examples, 8);
}

}  // namespace
}  // namespace fathom::test
