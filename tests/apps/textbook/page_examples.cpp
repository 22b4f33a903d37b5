#include "tests/apps/textbook/page_examples.h"

#include <istream>

namespace fathom::test {
namespace {

std::string without_indent(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

}  // namespace

std::vector<Example> examples_of(std::istream& page) {
  std::vector<Example> examples;
  bool fenced = false, of_example = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      fenced = !fenced;
      of_example = false;
    } else if (fenced && line.starts_with("$ ")) {
      examples.push_back({line.substr(2), ""});
      of_example = true;
    } else if (of_example) {
      examples.back().printed += without_indent(line);
    }
  }
  return examples;
}

Outcome run_in_shell(const std::string& command, const std::filesystem::path& folder) {
  const std::string programs = std::filesystem::path(program_path()).parent_path();
  return run({"/bin/bash", "-c", "PATH=$0:$PATH; " + command, programs}, {.folder = folder});
}

}  // namespace fathom::test
