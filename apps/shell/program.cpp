#include "apps/shell/program.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "apps/shell/command_text.h"
#include "apps/shell/failures.h"
#include "apps/shell/help_command.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/failure_kind.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::app {
namespace {

/// The names of a command's options, with their dashes.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// "--size" of "--size=640x480".
std::string without_value(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

/// End of the message about an unknown name: the similar names.
std::string behind_name(const std::vector<std::string>& near) {
  const std::string text = did_you_mean(near);
  return text.empty() ? text : ": " + text;
}

/// Compares names without dashes, which all options share. Names that the help does not show are
/// not suggested.
std::string suggested_option(const std::string& name, const CLI::App& command) {
  const std::size_t dashes = name.starts_with("--") ? 2 : 1;
  std::vector<std::string> bare;
  for (const std::string& each : option_names(command)) {
    if (each == other_name_of_output) continue;
    if ((each.starts_with("--") ? 2U : 1U) == dashes) bare.push_back(each.substr(dashes));
  }
  std::vector<std::string> near = nearest_names(name.substr(dashes), bare);
  for (std::string& each : near) each.insert(0, name, 0, dashes);
  return behind_name(near);
}

/// "; --range takes LOW,HIGH, with a comma", if such an option was given; otherwise empty.
std::string hint_of_commas(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string value = option->get_type_name();
    if (option->count() > 0 && value.find(',') != std::string::npos)
      return fmt::format("; {} takes {}, with a comma", option->get_name(), value);
  }
  return "";
}

std::string unexpected_of(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  const std::vector<std::string> existing = commands_below(command);
  // Options after a misspelt command are unknown too, but they belong to the intended command.
  if (!rest.empty() && !rest[0].starts_with('-') && !existing.empty() &&
      command.get_subcommands().empty()) {
    return unknown_command(rest[0], existing);
  }
  const auto option = std::ranges::find_if(
      rest, [](const std::string& text) { return text.size() > 1 && text.starts_with('-'); });
  if (option != rest.end() && *option != "--") {
    const std::string name = without_value(*option);
    return fmt::format("there is no option '{}'{}", name, suggested_option(name, command));
  }
  if (rest.empty()) return "";
  if (!existing.empty()) return unknown_command(rest[0], existing);
  return fmt::format("unexpected argument '{}'{}", rest[0], hint_of_commas(command));
}

}  // namespace

std::vector<std::string> commands_below(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(below->get_name());
  return names;
}

std::string unknown_command(const std::string& name, const std::vector<std::string>& existing) {
  std::vector<std::string> meant = nearest_names(name, existing);
  if (name == "explain") meant = {"probe", "validate"};
  const std::string suggestion = behind_name(meant);
  return fmt::format("there is no command '{}'{} {}", name,
                     suggestion.empty() ? "; the commands are" : suggestion + " The commands are",
                     joined(existing));
}

std::string unexpected_argument(const CLI::App& program) {
  const CLI::App* command = &program;
  for (;;) {
    std::string message = unexpected_of(*command);
    if (!message.empty()) return message;
    if (command->get_subcommands().empty()) return "";
    command = command->get_subcommands().front();
  }
}

std::string missing_dash(const CLI::App& program, const std::vector<std::string>& arguments) {
  const std::vector<std::string> names = option_names(command_named(program, arguments));
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    const std::string name = without_value(argument);
    if (name.size() < 3 || !name.starts_with('-') || name.starts_with("--")) continue;
    if (std::ranges::count(names, "-" + name) > 0)
      return fmt::format("there is no option '{}'{}", name, behind_name({"-" + name}));
  }
  return "";
}

std::string missing_value(const CLI::App& program, const std::vector<std::string>& arguments) {
  const CLI::App& command = command_named(program, arguments);
  const std::vector<std::string> names = option_names(command);
  for (std::size_t i = 0; i + 1 < arguments.size() && arguments[i] != "--"; ++i) {
    if (std::ranges::count(names, arguments[i]) == 0) continue;
    const bool takes_value = command.get_option(arguments[i])->get_items_expected_min() > 0;
    if (takes_value && std::ranges::count(names, arguments[i + 1]) > 0)
      return fmt::format("{} needs a value, found the option {}", arguments[i], arguments[i + 1]);
  }
  return "";
}

const CLI::App& command_named(const CLI::App& program, const std::vector<std::string>& arguments) {
  const CLI::App* command = &program;
  for (const std::string& argument : arguments) {
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; })) {
      if (below->get_name() != argument) continue;
      command = below;
      break;
    }
  }
  return *command;
}

namespace {

constexpr const char* examples =
    "  fathom render spot.obj -o spot.exr\n"
    "  fathom preview spot.exr -o spot.png\n"
    "  fathom probe spot.obj --pixel 640,360\n"
    "\n'fathom COMMAND --help' or 'fathom help COMMAND' explains a command. "
    "'fathom COMMAND -h' lists its options on one screen.";

/// Where a package has installed pages and examples.
std::string documents_text() {
  const std::string folder = FATHOM_DOCUMENTS;
  if (folder.empty()) return "";
  return "\n\nDocumentation: " + folder + "/docs/index.md\n\nMeshes and scenes to try: " + folder +
         "/examples";
}

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

/// What CLI11 says, in Fathom's words where its own are hard to understand.
std::string said_by(const CLI::ParseError& error) {
  const std::string message = error.what();
  const std::size_t at = message.find(": At Most 1 required but received ");
  if (at == std::string::npos) return message;
  return message.substr(0, at) + " is given " + message.substr(message.rfind(' ') + 1) +
         " times, expected once";
}

/// Reports misspelt arguments before missing ones.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(app);
  std::string message = unexpected_argument(app);
  const std::vector<std::string> below = commands_below(command);
  if (message.empty() && !below.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) {
    message = "'" + names_above(command) + command.get_name() +
              "' needs a command: " + joined(below, " or ");
  }
  return (message.empty() ? said_by(error) : message) + "; see '" + names_above(command) +
         command.get_name() + " --help'";
}

/// If the arguments name a command of another program, starts that program: a companion, or any
/// program fathom-COMMAND in the same folder.
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

ExitStatus status_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::usage:
      return wrong_usage;
    case FailureKind::output:
      return unwritable_output;
    case FailureKind::internal:
      return internal_error;
    case FailureKind::input:
    case FailureKind::memory:
    case FailureKind::threads:
      break;
  }
  return unusable_input;
}

/// Where the library names a setting, the user gave an option of that name.
std::string message_of(const Error& error) {
  std::string message = error.what();
  if (error.setting().empty()) return message;
  std::string option = "--" + error.setting();
  std::replace(option.begin(), option.end(), '_', '-');
  return option + message.substr(error.setting().size());
}

/// "PATH: why", where a path is known.
std::string message_of(const std::system_error& error) {
  const std::string why = error.code().message();
  const auto* const about = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (about != nullptr && !about->path1().empty()) return about->path1().string() + ": " + why;
  return "the system refuses: " + why;
}

std::string message_of(const std::exception& failure) {
  if (const auto* error = dynamic_cast<const Error*>(&failure)) return message_of(*error);
  if (const auto* error = dynamic_cast<const std::system_error*>(&failure))
    return message_of(*error);
  return std::string("unexpected: ") + failure.what();
}

/// Reports the lack of threads and ends the program without destructors. Outputs are already taken
/// back. oneTBB's threads that did start may still be running; destroying the objects that they use
/// would crash them with another message.
[[noreturn]] void leave_without_threads() {
  std::_Exit(report_lack_of_threads());
}

int report(const std::exception& failure) {
  const FailureKind kind = kind_of(failure);
  if (kind == FailureKind::memory) return report_out_of_memory();
  if (kind == FailureKind::threads) leave_without_threads();
  const std::string message = message_of(failure);
  have_the_last_word();
  if (may_report()) Console::error(message);
  return status_of(kind);
}

int run_reporting(const std::function<int()>& run) {
  try {
    open_missing_streams();
    handle_signals();
    stay_within_control_group();
    return run();
  } catch (const std::exception& failure) {
    return report(failure);
  }
}

/// A message takes memory, too: if it cannot be allocated, the message is "out of memory".
int run_to_the_end(const std::function<int()>& run) {
  try {
    return outcome_is(run_reporting(run));
  } catch (const std::bad_alloc&) {
    return outcome_is(report_out_of_memory());
  } catch (const std::length_error&) {
    return outcome_is(report_out_of_memory());
  }
}

}  // namespace

int run_arguments(const std::vector<std::string>& given, const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions) {
  CLI::App app("Compute exact depth maps of triangle meshes", "fathom");
  Console console;
  Command program(app, console, examples + documents_text());
  program.requires_command();
  for (const AddCommand& add : commands) add(program);
  if (!companions.empty()) add_help(program, app, companions);
  for (const Companion& companion : companions) {
    app.add_subcommand(std::string(companion.command), std::string(companion.description))
        ->group(companion_heading);
  }

  if (given.empty() && !companions.empty()) {
    print(help_page(text_of(app), help_width()));
    return done;
  }
  if (const auto offers = asked_completion(program, companions, given)) {
    print(*offers);
    return done;
  }
  const std::vector<std::string> asked = with_help_as_option(given);
  start_other_program(app, asked, companions);
  if (const auto help = asked_help(app, program, asked)) {
    print(*help);
    return done;
  }
  for (const auto find_mistake : {missing_dash, missing_value})
    if (const std::string message = find_mistake(app, asked); !message.empty())
      throw UsageError(message);
  std::vector<std::string> last_first(asked.rbegin(), asked.rend());
  try {
    app.parse(std::move(last_first));
  } catch (const CLI::CallForHelp&) {
    const bool on_a_screen = std::ranges::count(asked, "-h") > 0;
    print((on_a_screen ? help_on_a_screen : help_page)(text_of(chosen_command(app)), help_width()));
    return done;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return done;
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(app, error));
  }
  return program.run_named(console);
}

int program_main(int argc, char** argv, CommandsFor* commands, CompanionsOf* companions) {
  prepare_last_resort();
  return run_to_the_end([&] {
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    return run_arguments(arguments, commands(arguments),
                         companions ? companions() : std::vector<Companion>());
  });
}

int companion_main(int argc, char** argv, const char* name, void (*command)(Command&)) {
  prepare_last_resort();
  return run_to_the_end([&] {
    std::vector<std::string> arguments{name};
    arguments.insert(arguments.end(), argv + std::min(argc, 1), argv + argc);
    return run_arguments(arguments, {command}, {});
  });
}

}  // namespace fathom::app
