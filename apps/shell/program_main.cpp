#include "apps/shell/program_main.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/shell/companion.h"
#include "apps/shell/output_file.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The first argument that is no option names the command. One that this program does not have is
/// started as a program of its own, if there is one.
void require_known_command(const CLI::App& app, const std::vector<char*>& arguments) {
  const auto name = std::find_if(arguments.begin(), arguments.end(),
                                 [](const char* argument) { return argument[0] != '-'; });
  if (name == arguments.end()) return;
  const std::vector<std::string> existing = command_names(app);
  if (std::find(existing.begin(), existing.end(), *name) != existing.end()) return;
  start_companion(*name, {name + 1, arguments.end()});
  throw UsageError(unknown_command(*name, existing));
}

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

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(app);
  return std::string(error.what()) + "; see '" + names_above(command) + command.get_name() +
         " --help'";
}

/// Help and version are printed here; everything else is run by the command.
int parse_and_run(Program& program, int argc, char** argv) {
  const std::vector<char*> arguments(argv + std::min(argc, 1), argv + argc);
  require_known_command(program.app, arguments);
  try {
    program.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const CLI::App& command = chosen_command(program.app);
    std::string above = names_above(command);
    if (!above.empty()) above.pop_back();
    print(command.help(above));
    return done;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return done;
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(program.app, error));
  }
  return program.run();
}

int report(ExitStatus status, const std::string& message) {
  Console::error(message);
  return status;
}

}  // namespace

int program_main(int argc, char** argv, const std::vector<AddCommand>& commands) {
  try {
    remove_outputs_when_interrupted();
    Program program;
    for (const AddCommand add : commands) add(program);
    program.name_values();
    return parse_and_run(program, argc, argv);
  } catch (const UsageError& error) {
    return report(wrong_usage, error.what());
  } catch (const InputError& error) {
    return report(unusable_input, error.what());
  } catch (const OutputError& error) {
    return report(unwritable_output, error.what());
  } catch (const std::bad_alloc&) {
    return report(unusable_input, "out of memory: the input or the image is too large");
  } catch (const std::length_error&) {
    return report(unusable_input, "out of memory: the input or the image is too large");
  } catch (const std::exception& error) {
    return report(internal_error, std::string("unexpected: ") + error.what());
  }
}

int companion_main(int argc, char** argv, const char* name, AddCommand command) {
  std::vector<std::string> words{"fathom", name};
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  std::vector<char*> arguments;
  arguments.reserve(words.size());
  for (std::string& word : words) arguments.push_back(word.data());
  return program_main(static_cast<int>(arguments.size()), arguments.data(), {command});
}

}  // namespace fathom::app
