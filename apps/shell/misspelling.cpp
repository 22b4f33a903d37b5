#include "apps/shell/misspelling.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "apps/shell/command_text.h"
#include "apps/shell/values.h"
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
  return fmt::format("unexpected argument '{}'", rest[0]);
}

}  // namespace

std::vector<std::string> commands_below(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(below->get_name());
  return names;
}

std::string unknown_command(const std::string& name, const std::vector<std::string>& existing) {
  const std::string suggestion = behind_name(nearest_names(name, existing));
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

}  // namespace fathom::app
