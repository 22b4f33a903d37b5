#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"

/// The examples of documentation pages, to be run as a reader would.
namespace fathom::test {

/// A command line of a shell and what the page says that it prints, without line breaks and
/// indentation.
struct Example {
  std::string command, printed;
};

/// Of a fenced block: each line that begins with "$ ", and the lines that follow it.
std::vector<Example> examples_of(std::istream& page);

/// Runs a command line in a folder, with the built programs on the PATH.
Outcome run_in_shell(const std::string& command, const std::filesystem::path& folder);

}  // namespace fathom::test
