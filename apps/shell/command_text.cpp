#include "apps/shell/command_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "apps/shell/values.h"

namespace fathom::app {
namespace {

std::vector<std::string> path_of(const CLI::App& command) {
  std::vector<std::string> path;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent())
    path.insert(path.begin(), app->get_name());
  return path;
}

/// Options that exclude each other are declared in any order and listed in the order of the help.
std::vector<std::string> excluded_by(const CLI::Option& option,
                                     const std::vector<const CLI::Option*>& all) {
  std::vector<std::string> names;
  for (const CLI::Option* other : all) {
    if (option.get_excludes().contains(const_cast<CLI::Option*>(other)))
      names.push_back(other->get_name());
  }
  return names;
}

OptionText option_text(const CLI::Option& option, const std::vector<const CLI::Option*>& all) {
  OptionText text;
  text.is_argument = option.get_positional();
  if (text.is_argument) {
    text.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    if (text.names.size() > 1) std::erase(text.names, other_name_of_output);
    if (option.get_items_expected_max() > 0) text.value = option.get_type_name();
  }
  text.help = option.get_description();
  text.heading = text.is_argument ? "Arguments" : option.get_group();
  text.excluded = excluded_by(option, all);
  text.is_required = option.get_required();
  text.takes_several = option.get_items_expected_max() > 1 && option.get_allow_extra_args();
  return text;
}

/// The examples at the beginning of a footer are indented; paragraphs that are not follow them.
void take_apart(const std::string& footer, CommandText& text) {
  const std::size_t end = footer.find("\n\n");
  text.examples = footer.substr(0, end);
  if (end != std::string::npos) text.notes = footer.substr(end + 2);
}

}  // namespace

CommandText text_of(const CLI::App& command) {
  CommandText text;
  text.path = path_of(command);
  text.summary = command.get_description();
  const std::vector<const CLI::Option*> options = command.get_options();
  for (const bool arguments : {true, false}) {
    for (const CLI::Option* option : options) {
      // Options without a heading are refused with a reason, and stand in no list.
      if (option->get_positional() == arguments && !option->get_group().empty())
        text.options.push_back(option_text(*option, options));
    }
  }
  const auto every = [](const CLI::App*) { return true; };
  for (const CLI::App* below : command.get_subcommands(every))
    text.commands.push_back({below->get_group(), below->get_name(), below->get_description()});
  take_apart(command.get_footer(), text);
  return text;
}

std::string CommandText::name() const {
  return fmt::format("{}", fmt::join(path, " "));
}

std::vector<std::string> CommandText::headings() const {
  std::vector<std::string> headings;
  const auto note = [&](const std::string& heading) {
    if (std::ranges::count(headings, heading) == 0) headings.push_back(heading);
  };
  for (const OptionText& option : options) note(option.heading);
  for (const Below& below : commands) note(below.heading);
  return headings;
}

std::string CommandText::synopsis() const {
  std::string line = name() + " [OPTIONS]";
  for (const OptionText& option : options) {
    if (!option.is_argument) continue;
    const std::string shown = option.names[0] + (option.takes_several ? "..." : "");
    line += option.is_required ? " " + shown : " [" + shown + "]";
  }
  return commands.empty() ? line : line + " COMMAND";
}

const std::string& name_of(const OptionText& option) {
  return option.names.back();
}

std::string meaning_of(const OptionText& option) {
  std::string text = option.help;
  if (option.is_required && !option.is_argument) text += "; required";
  if (!option.excluded.empty()) text += "; not with " + joined(option.excluded, " or ");
  return text;
}

std::size_t columns(const std::string& text) {
  // Bytes that begin a character.
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> paragraphs;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    paragraphs.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return paragraphs;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = !lines.empty() && columns(lines.back()) + 1 + columns(word) <= width;
    if (fits) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace fathom::app
