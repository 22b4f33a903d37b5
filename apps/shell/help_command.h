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

/// The help to print if an argument is --help=FORM; otherwise nothing.
/// Fails    UsageError for an unknown command or form.
std::optional<std::string> asked_help(const CLI::App& program, const Command& commands,
                                      const std::vector<std::string>& arguments);

/// The answer to `fathom complete -- WORDS`, which the scripts of `completion` call: offers_for()
/// these words. Nothing for other arguments.
std::optional<std::string> asked_completion(const Command& program,
                                            const std::vector<Companion>& companions,
                                            const std::vector<std::string>& arguments);

/// Declares `completion` and `help`. All forms of `help` except --output run before arguments are
/// read.
void add_help(Command& program, const CLI::App& app, const std::vector<Companion>& companions);

}  // namespace fathom::app
