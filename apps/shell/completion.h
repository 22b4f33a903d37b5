#pragma once

#include <string>
#include <vector>

#include "apps/shell/completion_table.h"

namespace fathom::app {

/// What a shell can offer for the last of these words of a command line, the first of which is the
/// program. A line that says what else belongs there, then a line for each word with its help:
///
///   FILES KIND        FILES is none, all or folders: names of files are offered too. KIND is list
///                     if another word may follow behind a comma, else word
///   WORD <tab> HELP   in place of the last word
///
/// Bash passes --engine=p and a:b as three words each; WORD then replaces the last of them. Words
/// are offered whatever has been typed: shells match in their own ways.
std::string offers_for(const CompletionTable& table, const std::vector<std::string>& words);

/// Scripts that are sourced, or installed where the shell looks for them: they call
/// `fathom complete -- WORDS` when the user presses Tab.
extern const char* const bash_completion;
extern const char* const zsh_completion;
extern const char* const fish_completion;

}  // namespace fathom::app
