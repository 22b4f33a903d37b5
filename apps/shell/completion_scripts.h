#pragma once

#include <string>

#include "apps/shell/completion_table.h"

namespace fathom::app {

/// Scripts that let a shell complete the arguments of `fathom`. Each holds the table as data and
/// a function that looks into it: the program is not run when the user presses Tab.
/// They are sourced, or installed where the shell looks for them.
std::string bash_completion(const CompletionTable& table);
std::string zsh_completion(const CompletionTable& table);
std::string fish_completion(const CompletionTable& table);

}  // namespace fathom::app
