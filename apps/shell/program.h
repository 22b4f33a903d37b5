#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/companion.h"

namespace fathom::app {

using AddCommand = std::function<void(Command& program)>;

/// Does what the arguments of a program with these commands ask for: runs the command that they
/// name, shows help or the version, or starts the companion that has the command.
/// Fails    UsageError where they make no sense; as the command fails.
int run_arguments(const std::vector<std::string>& arguments,
                  const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions);

/// The commands of a program that was given these arguments.
using CommandsFor = std::vector<AddCommand>(const std::vector<std::string>& arguments);
using CompanionsOf = std::vector<Companion>();

/// The whole of a program that has these commands, and companions for others: does what the
/// arguments ask for, and turns a failure into one line on standard error and its exit status.
/// Functions are passed because even a list of commands takes memory, of which there may be none.
int program_main(int argc, char** argv, CommandsFor* commands, CompanionsOf* companions = nullptr);

/// The whole of `fathom-NAME`, which takes the arguments of `fathom NAME` and speaks as that.
int companion_main(int argc, char** argv, const char* name, void (*command)(Command&));

}  // namespace fathom::app
