#include "apps/shell/help_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/shell/command.h"
#include "apps/shell/command_text.h"
#include "apps/shell/completion.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::app {
namespace {

constexpr const char* version_of_pages = "Fathom " FATHOM_VERSION;
const std::string form_option = "--help=";

const char* parse_shell(const std::string& text) {
  return parse_word<const char*>(
      text, {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}});
}

/// The command that all words name, each below the one before.
const CLI::App& command_of(const CLI::App& program, const std::vector<std::string>& arguments) {
  const CLI::App* command = &program;
  for (const std::string& name : arguments) {
    if (name.starts_with('-')) continue;
    const std::vector<std::string> existing = commands_below(*command);
    if (std::ranges::count(existing, name) == 0) {
      throw UsageError(existing.empty()
                           ? "'" + command->get_name() + "' has no command '" + name + "' below it"
                           : unknown_command(name, existing));
    }
    command = command->get_subcommand(name);
  }
  return *command;
}

/// All commands of the program and of those built companions that `is_asked` chooses; only the
/// names of all other companions.
CompletionTable whole_table(const Command& program, const std::vector<Companion>& companions,
                            const std::function<bool(const Companion&)>& is_asked) {
  CompletionTable table = program.completion_table();
  for (const Companion& companion : companions) {
    CompletionTable more;
    if (is_asked(companion)) {
      const auto lines = answer_of(companion, {form_option + "completion"});
      if (lines) more = table_from_lines(*lines);
    }
    if (more.empty())
      more = {{{"fathom", std::string(companion.command)}, std::string(companion.description), {}}};
    table.insert(table.end(), more.begin(), more.end());
  }
  return table;
}

/// A command of this program, or one of a companion, as a page. Nothing where that is not built.
std::optional<std::string> page_of(const std::vector<std::string>& path, const CLI::App& app,
                                   const std::vector<Companion>& companions) {
  const std::vector<std::string> names(path.begin() + 1, path.end());
  const auto companion = std::ranges::find_if(companions, [&](const Companion& each) {
    return !names.empty() && each.command == names[0];
  });
  if (companion == companions.end())
    return man_page(text_of(command_of(app, names)), version_of_pages);
  std::vector<std::string> arguments(names.begin() + 1, names.end());
  arguments.push_back(form_option + "man");
  return answer_of(*companion, arguments);
}

void write_pages(const std::string& folder, const CompletionTable& table, const CLI::App& app,
                 const std::vector<Companion>& companions) {
  make_folder(folder);
  for (const CompletedCommand& command : table) {
    const auto page = page_of(command.path, app, companions);
    if (page) write_text(std::filesystem::path(folder) / (man_name(command.path) + ".1"), *page);
  }
}

}  // namespace

std::vector<std::string> with_help_as_option(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0] != "help") return arguments;
  std::vector<std::string> asked;
  std::string form = form_option + "text";
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!argument.starts_with('-')) {
      asked.push_back(argument);
    } else if (argument == "--man") {
      form = form_option + "man";
    } else if (argument.starts_with("--out") || argument.starts_with("-o")) {
      return arguments;
    } else if (argument != "--quiet") {
      return {"help", argument};  // about `help` itself, or wrong
    }
  }
  asked.push_back(form);
  return asked;
}

std::optional<std::string> asked_help(const CLI::App& program, const Command& commands,
                                      const std::vector<std::string>& arguments) {
  const auto form = std::ranges::find_if(
      arguments, [](const std::string& text) { return text.starts_with(form_option); });
  if (form == arguments.end()) return std::nullopt;
  const std::vector<std::string> words(arguments.begin(), form);
  const CLI::App& command = command_of(program, words);
  const std::string name = form->substr(form_option.size());
  if (name == "man") return man_page(text_of(command), version_of_pages);
  if (name == "text") return help_page(text_of(command), help_width());
  if (name != "completion")
    throw UnknownName("--help: there is no form '" + name + "'", name,
                      {"text", "man", "completion"});
  const std::vector<std::string> path = text_of(command).path;
  CompletionTable table;
  for (const CompletedCommand& each : commands.completion_table()) {
    if (each.path.size() >= path.size() && std::equal(path.begin(), path.end(), each.path.begin()))
      table.push_back(each);
  }
  return to_lines(table);
}

std::optional<std::string> asked_completion(const Command& program,
                                            const std::vector<Companion>& companions,
                                            const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments[0] != "complete" || arguments[1] != "--")
    return std::nullopt;
  const std::vector<std::string> words(arguments.begin() + 2, arguments.end());
  const auto is_named = [&](const Companion& companion) {
    return std::ranges::count(words, companion.command) > 0;
  };
  return offers_for(whole_table(program, companions, is_named), words);
}

void add_help(Command& program, const CLI::App& app, const std::vector<Companion>& companions) {
  struct HelpArguments {
    std::vector<std::string> names;
    bool man = false;
    std::string folder;
  };
  const auto help = std::make_shared<HelpArguments>();
  Command& command = program.command("help", "Explain a command, or show its manual page",
                                     "  fathom help camera look-at\n"
                                     "  fathom help --man render | man -l -\n"
                                     "  fathom help --man -o ~/.local/share/man/man1");
  command.arguments("COMMAND", help->names, "Name of the command, e.g. 'camera orbit'");
  command.flag("--man", help->man,
               "Print the manual page (roff); pipe it to 'man -l -' to read it");
  add_output_option(
      command, "DIR", help->folder,
      "Write the manual pages of all commands that are built to this folder; needs --man");
  command.runs([help, &program, &app, companions](const Console&) -> int {
    if (!help->man || !help->names.empty())
      throw UsageError("--output goes with --man, and without a COMMAND");
    const std::string folder = help->folder;  // which the table overwrites
    const auto all = [](const Companion&) { return true; };
    write_pages(folder, whole_table(program, companions, all), app, companions);
    return done;
  });

  const auto script = std::make_shared<const char*>(nullptr);
  Command& completion =
      program.command("completion", "Print a shell completion script",
                      "  source <(fathom completion bash)      # in ~/.bashrc\n"
                      "  source <(fathom completion zsh)       # in ~/.zshrc, after compinit\n"
                      "  fathom completion fish | source       # in ~/.config/fish/config.fish");
  completion.argument("SHELL", into(*script, parse_shell), "bash, zsh or fish").required();
  completion.answers_on_standard_output();
  completion.runs([script](const Console&) {
    print(*script);
    return done;
  });
}

}  // namespace fathom::app
