#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace fathom::app {

/// The message for a command that does not exist, with the one of these that it resembles.
std::string unknown_command(const std::string& name, const std::vector<std::string>& existing);

/// The names of the commands below one.
std::vector<std::string> commands_below(const CLI::App& command);

/// Message about the first argument that no command accepts: a misspelt option or command, or an
/// argument too many. Empty if every argument is accepted.
std::string unexpected_argument(const CLI::App& program);

/// A long option with one dash, "-output", would be taken for -o with the value "utput". The
/// message where one of the arguments is that; empty where none is.
std::string missing_dash(const CLI::App& program, const std::vector<std::string>& arguments);

/// The innermost command that the arguments name. Options may stand between the names, but not
/// options with values.
const CLI::App& command_named(const CLI::App& program, const std::vector<std::string>& arguments);

}  // namespace fathom::app
