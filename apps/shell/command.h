#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/command_text.h"
#include "apps/shell/completion.h"
#include "apps/shell/console.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fathom::app {

/// Parses the text of an option.
/// Fails    UsageError with the fault of the text; the caller puts the option's name before it.
using TakeText = std::function<void(const std::string& text)>;

/// Stores the result of `parse` for the text in `value` (see values.h).
template <class Value, class Parse>
TakeText into(Value& value, Parse parse) {
  return [&value, parse](const std::string& text) { value = parse(text); };
}

/// An option that a command has declared.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}
  /// The command fails without it.
  Option& required();
  /// The two are not given together.
  Option& excludes(const Option& other);
  /// The help shows it below this heading.
  Option& below(const std::string& heading);
  [[nodiscard]] bool is_given() const;
  /// "--near"
  [[nodiscard]] std::string name() const;

 private:
  CLI::Option* option_;
};

/// The declaration of a command: its options and the function that runs it. Commands use the
/// library that reads arguments only through this class. The variables of the options must outlive
/// the command. They are written when all arguments have been read, if the arguments name this
/// command.
class Command {
 public:
  /// Returns the exit status. Fails with the errors of fathom/failures/errors.h.
  using Run = std::function<int(const Console&)>;

  /// `console` gets --quiet.
  Command(CLI::App& app, Console& console, const std::string& examples);
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command();

  /// A command below this one, with --max-memory; `examples` end its help.
  Command& command(const std::string& name, const std::string& description,
                   const std::string& examples);
  /// For a family: the arguments must name a command below it.
  void requires_command();
  /// The help shows options that are declared after this call below this heading.
  void begin_group(const std::string& heading) { heading_ = heading; }

  /// An option with one value, "-o,--output"; the help shows it as "-o,--output MAP".
  Option option(const std::string& names, const std::string& value_name, std::string& value,
                const std::string& help);
  Option option(const std::string& names, const std::string& value_name, TakeText take,
                const std::string& help);
  /// An option that may be given several times, with one value each.
  Option repeated_option(const std::string& names, const std::string& value_name,
                         std::function<void(const std::vector<std::string>&)> take,
                         const std::string& help);
  Option option_with_values(const std::string& names, const std::string& value_name,
                            std::vector<std::string>& values, const std::string& help);
  Option flag(const std::string& name, bool& value, const std::string& help);
  /// A positional argument.
  Option argument(const std::string& name, std::string& value, const std::string& help);
  Option argument(const std::string& name, TakeText take, const std::string& help);
  Option arguments(const std::string& name, std::vector<std::string>& values,
                   const std::string& help);

  /// Words that completion offers for an option whose parser also accepts other texts.
  void offer(const Option& option, std::vector<std::string> words);

  /// The command prints its answer; if standard output is unusable, it fails before any work.
  void answers_on_standard_output() { answers_on_standard_output_ = true; }
  void runs(Run run) { run_ = std::move(run); }

  /// Writes the given values to their variables, then runs the named command below this one, or
  /// this command.
  int run_named(const Console& console) const;

  /// Completion data of this command and all commands below it. The words of an option come from
  /// its parser, which refuses an impossible text with an UnknownName that lists them
  /// (fathom/failures/unknown_name.h). The variables of the options are garbage afterwards.
  [[nodiscard]] CompletionTable completion_table() const;

 private:
  [[nodiscard]] CompletedOption completed(const OptionText& option) const;
  Option taken_by(CLI::Option& option, std::function<void(const std::vector<std::string>&)> take);
  Option in_group(CLI::Option& option) const;

  struct Taken {
    CLI::Option* option;
    std::function<void(const std::vector<std::string>&)> take;
    std::vector<std::string> offered;
  };
  CLI::App& app_;
  Console& console_;
  std::string heading_;
  std::vector<Taken> taken_;
  std::vector<std::unique_ptr<Command>> commands_;
  Run run_;
  bool answers_on_standard_output_ = false;
};

/// The option for the output of a command: "-o,--output", and other_name_of_output. `target`
/// is a std::string or a TakeText.
template <class Target>
Option add_output_option(Command& command, const std::string& value_name, Target&& target,
                         const std::string& help) {
  return command.option(std::string("-o,--output,") + other_name_of_output, value_name,
                        std::forward<Target>(target), help);
}

/// The same, for a command that may have several outputs.
Option add_output_options(Command& command, const std::string& value_name,
                          std::function<void(const std::vector<std::string>&)> take,
                          const std::string& help);

}  // namespace fathom::app
