#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/companion.h"

namespace CLI {
class App;
}  // namespace CLI

/// The main functions of programs, and messages about misspelt arguments.
namespace fathom::app {

/// The message for a command that does not exist, with the existing command that it resembles.
std::string unknown_command(const std::string& name, const std::vector<std::string>& existing);

/// The names of the commands below a command.
std::vector<std::string> commands_below(const CLI::App& command);

/// Message about the first argument that no command accepts: a misspelt option or command, or an
/// argument too many. Empty if every argument is accepted.
std::string unexpected_argument(const CLI::App& program);

/// A long option with one dash, "-output", would be read as -o with the value "utput". Returns the
/// message if an argument is such an option, else an empty text.
std::string missing_dash(const CLI::App& program, const std::vector<std::string>& arguments);

/// An option that needs a value would take the next option as its value: "--size -o". Returns the
/// message if the arguments contain such a pair, else an empty text.
std::string missing_value(const CLI::App& program, const std::vector<std::string>& arguments);

/// The innermost command that the arguments name. Options may stand between the names, but not
/// options with values.
const CLI::App& command_named(const CLI::App& program, const std::vector<std::string>& arguments);

using AddCommand = std::function<void(Command& program)>;

/// Carries out the arguments of a program with these commands: runs the named command, shows help
/// or the version, or starts the companion that has the command.
/// Fails    UsageError for invalid arguments; as the command fails.
int run_arguments(const std::vector<std::string>& arguments,
                  const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions);

/// The commands of a program that was given these arguments.
using CommandsFor = std::vector<AddCommand>(const std::vector<std::string>& arguments);
using CompanionsOf = std::vector<Companion>();

/// The main function of a program with these commands and companions: carries out the arguments,
/// and turns a failure into one line on standard error and an exit status. Functions are passed
/// because even a list of commands takes memory, which may have run out.
int program_main(int argc, char** argv, CommandsFor* commands, CompanionsOf* companions = nullptr);

/// The main function of `fathom-NAME`, whose arguments and messages are those of `fathom NAME`.
int companion_main(int argc, char** argv, const char* name, void (*command)(Command&));

}  // namespace fathom::app
