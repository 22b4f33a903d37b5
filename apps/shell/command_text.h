#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace fathom::app {

/// Heading of commands in lists, except commands that are separate programs.
inline constexpr const char* command_heading = "Commands";

/// The spelling that every "-o,--output" also takes. Help and completion show one name only.
inline constexpr const char* other_name_of_output = "--out";

/// Description of an option. Help, man pages and completion are all made from it.
struct OptionText {
  std::vector<std::string> names;     ///< "-o", "--output"; of an argument "SCENE"
  std::string value;                  ///< "FILE"; empty for flags and arguments
  std::string help;                   ///< one line
  std::string heading;                ///< heading above it: "Options"
  std::vector<std::string> excluded;  ///< options that exclude it: "--view"
  bool is_argument = false;           ///< given without a name
  bool is_required = false;
  bool takes_several = false;
};

/// Description of a command, in the order of its declaration.
struct CommandText {
  struct Below {
    std::string heading;  ///< "Commands"
    std::string name;     ///< "orbit"
    std::string summary;
  };

  std::vector<std::string> path;  ///< "fathom", "camera", "orbit"
  std::string summary;            ///< one line
  std::vector<OptionText> options;
  std::vector<Below> commands;
  std::string examples;  ///< lines that are kept as they are
  std::string notes;     ///< paragraphs, with empty lines between them

  /// The headings of options and commands, in the order of first occurrence.
  [[nodiscard]] std::vector<std::string> headings() const;
  /// "fathom camera orbit"
  [[nodiscard]] std::string name() const;
  /// "fathom camera orbit [OPTIONS] [SCENE...]"
  [[nodiscard]] std::string synopsis() const;
};

CommandText text_of(const CLI::App& command);

/// Name of an option in messages and lists: the long name if it has one.
const std::string& name_of(const OptionText& option);

/// Its help, and its relations to other options.
std::string meaning_of(const OptionText& option);

/// The number of columns of a UTF-8 text in which each character takes one column.
std::size_t columns(const std::string& text);

/// The parts of a text between empty lines.
std::vector<std::string> paragraphs_of(const std::string& text);

/// The words of a text in lines of at most `width` columns, except for words that are longer.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

/// The help of a command, as plain text of at most `width` columns; examples may be wider.
std::string help_page(const CommandText& command, std::size_t width);

/// The help of a command on one screen of 40 lines: the help_page() if it fits, else the names of
/// all options and the first example. A command with other commands below it keeps its help_page().
std::string help_on_a_screen(const CommandText& command, std::size_t width);

/// Width of help on standard output: the terminal's width, limited to 60 to 100 columns, or 80
/// without a terminal.
std::size_t help_width();

/// "fathom-camera-orbit", under which `man` finds the page of a command.
std::string man_name(const std::vector<std::string>& path);

/// The page of a command in section 1, in roff. It is dated by SOURCE_DATE_EPOCH (seconds since
/// 1970) where that is set, as packages that are built twice want it, and by today elsewhere.
std::string man_page(const CommandText& command, const std::string& version);

}  // namespace fathom::app
