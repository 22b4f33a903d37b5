#include "apps/shell/completion_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace fathom::app {
namespace {

using Files = CompletedValue::Files;

/// What values and arguments are called that are names of files.
constexpr std::array<std::string_view, 10> files{"FILE",  "MAP",    "SCENE", "TRUTH", "OTHER",
                                                 "INPUT", "REPORT", "PNG",   "SVG",   "PATH"};

Files files_called(const std::string& name) {
  if (name == "DIR") return Files::folders;
  return std::ranges::count(files, name) > 0 ? Files::all : Files::none;
}

constexpr std::array<const char*, 3> file_names{"none", "all", "folders"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string line_of(const CompletedOption& option) {
  return fmt::format("option\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", fmt::join(option.names, " "),
                     option.is_argument, option.takes_value, fmt::join(option.value.words, " "),
                     option.value.is_list, file_names[static_cast<std::size_t>(option.value.files)],
                     option.help);
}

CompletedOption option_of(const std::vector<std::string>& fields) {
  CompletedOption option;
  option.names = split(fields[1], ' ');
  option.is_argument = fields[2] == "true";
  option.takes_value = fields[3] == "true";
  option.value.words = split(fields[4], ' ');
  option.value.is_list = fields[5] == "true";
  for (std::size_t i = 0; i < file_names.size(); ++i) {
    if (fields[6] == file_names[i]) option.value.files = static_cast<Files>(i);
  }
  option.help = fields[7];
  return option;
}

}  // namespace

CompletedOption completed(const OptionText& option, std::vector<std::string> words, bool is_list) {
  CompletedOption made;
  made.names = option.names;
  made.help = option.help;
  made.is_argument = option.is_argument;
  made.takes_value = option.is_argument || !option.value.empty();
  made.value.words = std::move(words);
  made.value.is_list = is_list;
  made.value.files = files_called(option.is_argument ? option.names[0] : option.value);
  return made;
}

std::string to_lines(const CompletionTable& table) {
  std::string lines;
  for (const CompletedCommand& command : table) {
    lines += fmt::format("command\t{}\t{}\n", fmt::join(command.path, " "), command.help);
    for (const CompletedOption& option : command.options) lines += line_of(option);
  }
  return lines;
}

CompletionTable table_from_lines(const std::string& lines) {
  CompletionTable table;
  for (const std::string& line : split(lines, '\n')) {
    const std::vector<std::string> fields = split(line, '\t');
    if (fields.size() == 3 && fields[0] == "command")
      table.push_back({split(fields[1], ' '), fields[2], {}});
    else if (fields.size() == 8 && fields[0] == "option" && !table.empty())
      table.back().options.push_back(option_of(fields));
  }
  return table;
}

}  // namespace fathom::app
