#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace fathom::app {

/// What commands stand below in lists of them, unless they are programs of their own.
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

  /// What options and commands stand below, in the order in which each occurs first.
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

/// Columns of a UTF-8 text whose characters take one each.
std::size_t columns(const std::string& text);

/// The parts of a text between empty lines.
std::vector<std::string> paragraphs_of(const std::string& text);

/// The words of a text in lines of at most `width` columns, where words are not longer than that.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

}  // namespace fathom::app
