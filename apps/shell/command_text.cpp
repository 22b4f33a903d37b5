#include "apps/shell/command_text.h"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <string_view>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"

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

namespace {

constexpr std::size_t text_column = 26;
constexpr std::ptrdiff_t screen_lines = 40;

/// A name with its meaning next to it, or below a long name.
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

/// "Scene: --mesh-format, --threads, …" for each heading with options.
std::string names_by_heading(const CommandText& command, std::size_t width) {
  std::string text;
  for (const std::string& heading : command.headings()) {
    std::string names;
    for (const OptionText& option : command.options)
      if (option.heading == heading) names += (names.empty() ? " " : ", ") + name_of(option);
    text += "\n" + lines_of(heading + ":" + names, width);
  }
  return text;
}

/// The first of the examples, with the lines that continue it.
std::string first_example(const std::string& examples) {
  std::size_t end = examples.find('\n');
  while (end != std::string::npos && (examples[end - 1] == '\\' || examples[end - 1] == '|'))
    end = examples.find('\n', end + 1);
  return examples.substr(0, end);
}

std::time_t date_of_pages() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) return std::time(nullptr);
  try {
    return static_cast<std::time_t>(parse_count(epoch));
  } catch (const UsageError& error) {
    throw UsageError(std::string("SOURCE_DATE_EPOCH: ") + error.what());
  }
}

/// A text as roff: characters with a meaning in roff are escaped, and a hyphen stays a hyphen that
/// can be copied.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// A paragraph in lines that editors and patches like.
std::string roff_lines(const std::string& text) {
  std::string out;
  for (const std::string& line : wrapped(text, 60)) out += roff(line) + "\n";
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string in_capitals(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

std::string roff_section(const std::string& heading) {
  return ".SH \"" + roff(in_capitals(heading)) + "\"\n";
}

std::string roff_entry(const std::string& tag, const std::string& meaning) {
  return ".TP\n" + tag + "\n" + roff_lines(meaning);
}

std::string tag_of(const OptionText& option) {
  if (option.is_argument) return italic(option.names[0]) + (option.takes_several ? "..." : "");
  std::string tag;
  for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) tag += " " + italic(option.value);
  return option.takes_several ? tag + "..." : tag;
}

/// Sections: the entries below each heading of the help.
std::string roff_sections(const CommandText& command) {
  std::string text;
  for (const std::string& heading : command.headings()) {
    text += roff_section(heading);
    for (const OptionText& option : command.options) {
      if (option.heading == heading) text += roff_entry(tag_of(option), meaning_of(option));
    }
    for (const CommandText::Below& below : command.commands) {
      if (below.heading == heading) text += roff_entry(bold(below.name), below.summary);
    }
  }
  return text;
}

/// Paragraphs: an empty line becomes .PP.
std::string roff_paragraphs(const std::string& notes) {
  std::string text;
  for (const std::string& paragraph : paragraphs_of(notes))
    text += (text.empty() ? "" : ".PP\n") + roff_lines(paragraph);
  return text;
}

/// The pages of the command above it and of those below it.
std::string see_also(const CommandText& command) {
  std::vector<std::string> names;
  if (command.path.size() > 1)
    names.push_back(man_name({command.path.begin(), command.path.end() - 1}));
  for (const CommandText::Below& below : command.commands) {
    std::vector<std::string> path = command.path;
    path.push_back(below.name);
    names.push_back(man_name(path));
  }
  std::ranges::sort(names);
  std::string text;
  for (const std::string& name : names)
    text += ".BR " + roff(name) + " (1)" + (&name == &names.back() ? "\n" : ",\n");
  return text.empty() ? text : roff_section("See also") + text;
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

std::string help_on_a_screen(const CommandText& command, std::size_t width) {
  std::string page = help_page(command, width);
  if (!command.commands.empty() || std::ranges::count(page, '\n') <= screen_lines) return page;
  return lines_of(command.summary, width) + "Usage: " + command.synopsis() + "\n" +
         names_by_heading(command, width) + "\nExample:\n" + first_example(command.examples) +
         "\n\n'" + command.name() + " --help' explains all options and has more examples.\n";
}

std::size_t help_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::clamp<std::size_t>(size.ws_col, 60, 100);
}

std::string man_name(const std::vector<std::string>& path) {
  return fmt::format("{}", fmt::join(path, "-"));
}

std::string man_page(const CommandText& command, const std::string& version) {
  const std::string name = man_name(command.path);
  std::string text =
      fmt::format(".TH {} 1 {:%Y-%m-%d} \"{}\" \"User commands\"\n", roff(in_capitals(name)),
                  fmt::gmtime(date_of_pages()), roff(version));
  // No hyphens are put into words, nor spaces between them: options and numbers are to be copied.
  text += ".nh\n.ad l\n";
  text += roff_section("Name") + roff_lines(name + " - " + command.summary);
  const std::string synopsis = command.synopsis();
  text += roff_section("Synopsis") + bold(command.name()) +
          roff(synopsis.substr(command.name().size())) + "\n";
  text += roff_sections(command);
  if (!command.examples.empty())
    text += roff_section("Examples") + ".nf\n" + roff(command.examples) + "\n.fi\n";
  if (!command.notes.empty()) text += roff_section("Notes") + roff_paragraphs(command.notes);
  return text + see_also(command);
}

}  // namespace fathom::app
