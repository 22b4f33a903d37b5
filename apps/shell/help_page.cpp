#include "apps/shell/help_page.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

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

/// Entries below headings, each heading where it first occurs.
class Sections {
 public:
  void add(const std::string& heading, const std::string& entry) {
    auto section = std::ranges::find(sections_, heading, &Section::heading);
    if (section == sections_.end()) section = sections_.insert(section, {heading, ""});
    section->entries += entry;
  }

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [heading, entries] : sections_) text += "\n" + heading + ":\n" + entries;
    return text;
  }

 private:
  struct Section {
    std::string heading, entries;
  };
  std::vector<Section> sections_;
};

std::string paragraphs(const std::string& notes, std::size_t width) {
  std::string text;
  std::size_t begin = 0;
  while (begin < notes.size()) {
    const std::size_t end = std::min(notes.find("\n\n", begin), notes.size());
    text += "\n";
    for (const std::string& line : wrapped(notes.substr(begin, end - begin), width))
      text += line + "\n";
    begin = end + 2;
  }
  return text;
}

}  // namespace

std::string help_page(const CommandText& command, std::size_t width) {
  std::string text;
  for (const std::string& line : wrapped(command.summary, width)) text += line + "\n";
  text += "Usage: " + command.synopsis() + "\n";
  Sections sections;
  for (const OptionText& option : command.options)
    sections.add(option.heading, entry(shown_name(option), meaning_of(option), width));
  for (const CommandText::Below& below : command.commands)
    sections.add(below.heading, entry(below.name, below.summary, width));
  text += sections.text();
  if (!command.examples.empty()) text += "\nExamples:\n" + command.examples + "\n";
  return text + paragraphs(command.notes, width);
}

std::size_t help_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::clamp<std::size_t>(size.ws_col, 60, 100);
}

}  // namespace fathom::app
