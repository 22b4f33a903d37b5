#pragma once

#include <string>
#include <vector>

#include "apps/shell/command_text.h"

namespace fathom::app {

/// The accepted values at a place of the command line.
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

/// A command, followed by all commands below it.
using CompletionTable = std::vector<CompletedCommand>;

/// Completion data of an option, derived from its help: a value or an argument called FILE, MAP or
/// similar is a file. `words` are the words that its parser accepts.
CompletedOption completed(const OptionText& option, std::vector<std::string> words, bool is_list);

/// The table as lines of text, which a companion prints, and back.
std::string to_lines(const CompletionTable& table);
CompletionTable table_from_lines(const std::string& lines);

/// Completions of the last word of a command line, whose first word is the program. A line about
/// file names, then a line for each word with its help:
///
///   FILES KIND        FILES is none, all or folders: file names that are offered too. KIND is list
///                     if another word may follow behind a comma, else word
///   WORD <tab> HELP   in place of the last word
///
/// Bash passes --engine=p and a:b as three words each; WORD then replaces the last word. All words
/// are offered, because each shell matches the typed text in its own way.
std::string offers_for(const CompletionTable& table, const std::vector<std::string>& words);

/// Scripts for the user to source, or to install where the shell finds them. They call `fathom
/// complete -- WORDS` when the user presses Tab.
extern const char* const bash_completion;
extern const char* const zsh_completion;
extern const char* const fish_completion;

}  // namespace fathom::app
