#pragma once

#include <string>
#include <vector>

#include "apps/shell/command_text.h"

namespace fathom::app {

/// What can stand in a place of the command line.
struct CompletedValue {
  enum class Files { none, all, folders };

  std::vector<std::string> words;  ///< in the order in which the help has them
  bool is_list = false;            ///< several words with commas between them
  Files files = Files::none;
};

/// What completion knows of an option, of an argument or of a command.
struct CompletedOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument "SCENE"
  std::string help;
  bool is_argument = false;
  bool takes_value = false;  ///< not a flag
  CompletedValue value;
};

struct CompletedCommand {
  std::vector<std::string> path;  ///< "fathom", "camera"
  std::string help;
  std::vector<CompletedOption> options;
};

/// A command, and all those below it after it.
using CompletionTable = std::vector<CompletedCommand>;

/// What completion knows of an option, from what its help says: a value or an argument that is
/// called FILE, MAP or alike is a file. `words` are those that its parser knows.
CompletedOption completed(const OptionText& option, std::vector<std::string> words, bool is_list);

/// The table as lines of text, in which a companion hands it over, and back.
std::string to_lines(const CompletionTable& table);
CompletionTable table_from_lines(const std::string& lines);

}  // namespace fathom::app
