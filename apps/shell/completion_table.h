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

/// Completion data of an option, an argument or a command.
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

/// Completion data of an option, derived from its help: a value or an argument called FILE, MAP or
/// similar is a file. `words` are the words that its parser accepts.
CompletedOption completed(const OptionText& option, std::vector<std::string> words, bool is_list);

/// The table as lines of text, in which a companion hands it over, and back.
std::string to_lines(const CompletionTable& table);
CompletionTable table_from_lines(const std::string& lines);

}  // namespace fathom::app
