#include "apps/shell/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/shell/exit_status.h"
#include "apps/shell/help_command.h"
#include "apps/shell/help_page.h"
#include "apps/shell/misspelling.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

constexpr const char* examples =
    "  fathom render spot.obj -o spot.exr\n"
    "  fathom preview spot.exr -o spot.png\n"
    "  fathom probe spot.obj --pixel 640,360\n"
    "\n'fathom COMMAND --help' or 'fathom help COMMAND' explains a command.";

constexpr const char* companion_heading =
    "Companion programs; 'scripts/fathom COMMAND' in a clone of Fathom builds them";

/// The innermost command that the arguments name.
const CLI::App& chosen_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

/// "fathom camera " for `fathom camera orbit`.
std::string names_above(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? "" : names_above(*parent) + parent->get_name() + " ";
}

/// What is misspelt is named before what is missing.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(app);
  std::string message = unexpected_argument(app);
  const std::vector<std::string> below = commands_below(command);
  if (message.empty() && !below.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) {
    message = "'" + names_above(command) + command.get_name() +
              "' needs a command: " + joined(below, " or ");
  }
  return (message.empty() ? error.what() : message) + "; see '" + names_above(command) +
         command.get_name() + " --help'";
}

/// Where the arguments name a command that this program does not have itself, starts the program
/// that has it: a companion, or any that lies beside this one under the name fathom-COMMAND.
void start_other_program(const CLI::App& app, const std::vector<std::string>& arguments,
                         const std::vector<Companion>& companions) {
  const auto name = std::find_if(arguments.begin(), arguments.end(),
                                 [](const std::string& text) { return !text.starts_with('-'); });
  if (name == arguments.end()) return;
  const auto companion = std::find_if(companions.begin(), companions.end(),
                                      [&](const Companion& c) { return c.command == *name; });
  if (companion != companions.end() && companion->takes_name()) {
    start_companion(companion->program, arguments);
    throw UsageError(not_built("'" + *name + "'", companion->program, *name));
  }
  const std::vector<std::string> existing = commands_below(app);
  const bool is_own = companion == companions.end() &&
                      std::find(existing.begin(), existing.end(), *name) != existing.end();
  if (is_own) return;
  std::vector<std::string> without_name(arguments.begin(), name);
  without_name.insert(without_name.end(), name + 1, arguments.end());
  start_companion("fathom-" + *name, without_name);
  throw UsageError(companion == companions.end()
                       ? unknown_command(*name, existing)
                       : not_built("'" + *name + "'", companion->program, *name));
}

}  // namespace

int run_arguments(const std::vector<std::string>& given, const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions) {
  CLI::App app("Exact depth maps of triangle meshes.", "fathom");
  Console console;
  Command program(app, console, examples);
  program.requires_command();
  for (const AddCommand& add : commands) add(program);
  if (!companions.empty()) add_help(program, app, companions);
  for (const Companion& companion : companions) {
    app.add_subcommand(companion.command, companion.description)->group(companion_heading);
  }

  if (given.empty() && !companions.empty()) {
    print(help_page(text_of(app), help_width()));
    return done;
  }
  const std::vector<std::string> asked = with_help_as_option(given);
  start_other_program(app, asked, companions);
  if (const auto help = asked_help(app, program, asked)) {
    print(*help);
    return done;
  }
  if (const std::string message = missing_dash(app, asked); !message.empty())
    throw UsageError(message);
  std::vector<std::string> last_first(asked.rbegin(), asked.rend());
  try {
    app.parse(std::move(last_first));
  } catch (const CLI::CallForHelp&) {
    print(help_page(text_of(chosen_command(app)), help_width()));
    return done;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return done;
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(app, error));
  }
  return program.run_named(console);
}

}  // namespace fathom::app
