#include "apps/shell/help_page.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "apps/shell/wrapped.h"

namespace fathom::app {
namespace {

constexpr std::size_t text_column = 26;

/// A name with what it means beside it, or below it where the name is long.
std::string entry(const std::string& name, const std::string& meaning, std::size_t width) {
  std::string text = "  " + name;
  bool on_first_line = columns(text) + 2 <= text_column;
  for (const std::string& line : wrapped(meaning, width - text_column)) {
    text += on_first_line ? std::string(text_column - columns(text), ' ')
                          : "\n" + std::string(text_column, ' ');
    text += line;
    on_first_line = false;
  }
  return text + "\n";
}

/// "-o,--output FILE"
std::string shown_name(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ",") + name;
  if (!option.value.empty()) text += " " + option.value;
  return option.takes_several ? text + "..." : text;
}

std::string section(const CommandText& command, const std::string& heading, std::size_t width) {
  std::string text = "\n" + heading + ":\n";
  for (const OptionText& option : command.options)
    if (option.heading == heading) text += entry(shown_name(option), meaning_of(option), width);
  for (const CommandText::Below& below : command.commands)
    if (below.heading == heading) text += entry(below.name, below.summary, width);
  return text;
}

std::string lines_of(const std::string& paragraph, std::size_t width) {
  std::string text;
  for (const std::string& line : wrapped(paragraph, width)) text += line + "\n";
  return text;
}

}  // namespace

std::string help_page(const CommandText& command, std::size_t width) {
  std::string text = lines_of(command.summary, width);
  text += "Usage: " + command.synopsis() + "\n";
  for (const std::string& heading : command.headings()) text += section(command, heading, width);
  if (!command.examples.empty()) text += "\nExamples:\n" + command.examples + "\n";
  for (const std::string& paragraph : paragraphs_of(command.notes))
    text += "\n" + lines_of(paragraph, width);
  return text;
}

std::size_t help_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::clamp<std::size_t>(size.ws_col, 60, 100);
}

}  // namespace fathom::app
