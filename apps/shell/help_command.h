#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/companion.h"

namespace CLI {
class App;
}  // namespace CLI

namespace fathom::app {

/// `fathom help [--man] COMMAND…` asks the program that has the command by an argument that every
/// program understands: --help=text, --help=man, or --help=completion, which prints the
/// completion_table(). Returns the arguments in that form: "COMMAND… --help=man". Returns arguments
/// of other commands and of `help --man -o DIR` unchanged. Any other option of `help`, such as
/// `help --help`, is passed on unchanged, without the arguments that follow.
std::vector<std::string> with_help_as_option(std::vector<std::string> arguments);

/// What is printed where one of the arguments is --help=FORM; nothing where none is.
/// Fails    UsageError where there is no such command or form.
std::optional<std::string> asked_help(const CLI::App& program, const Command& commands,
                                      const std::vector<std::string>& arguments);

/// What is printed for `fathom complete -- WORDS`, which the scripts of `completion` call:
/// offers_for() these words. Nothing for other arguments.
std::optional<std::string> asked_completion(const Command& program,
                                            const std::vector<Companion>& companions,
                                            const std::vector<std::string>& arguments);

/// Declares `help`, which all but for --output is carried out before arguments are read, and
/// `completion`.
void add_help(Command& program, const CLI::App& app, const std::vector<Companion>& companions);

}  // namespace fathom::app
