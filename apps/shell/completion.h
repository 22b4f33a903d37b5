#pragma once

#include <string>
#include <vector>

#include "apps/shell/completion_table.h"

namespace fathom::app {

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

/// Scripts that are sourced, or installed where the shell looks for them: they call
/// `fathom complete -- WORDS` when the user presses Tab.
extern const char* const bash_completion;
extern const char* const zsh_completion;
extern const char* const fish_completion;

}  // namespace fathom::app
