#include "apps/shell/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "apps/shell/failures.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::app {
namespace {

constexpr const char* version_line = "fathom " FATHOM_VERSION;

/// A text that no option accepts as a word.
const std::string no_word = "\x01";

using Take = std::function<void(const std::vector<std::string>&)>;

/// The error with which a parser refuses a text that is not one of its words.
std::optional<UnknownName> refusal_of(const Take& take, const std::string& text) {
  try {
    take({text});
  } catch (const UnknownName& error) {
    return error;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// An empty value is mostly a variable of a script that is not set: it would pass for the default.
std::string complaint_of_nothing(const std::string& value) {
  return value.empty() ? "the value is empty" : "";
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::below(const std::string& heading) {
  option_->group(heading);
  return *this;
}

bool Option::is_given() const {
  return option_->count() > 0;
}

std::string Option::name() const {
  return option_->get_name();
}

Command::Command(CLI::App& app, Console& console, const std::string& examples)
    : app_(app), console_(console) {
  app.set_help_flag("-h,--help", "Show this help with an example");
  app.set_version_flag("--version", version_line, "Show the version");
  app.add_flag("--quiet", console.quiet, "Print no warnings and no progress");
  app.footer(examples);
}

Command::~Command() = default;

Command& Command::command(const std::string& name, const std::string& description,
                          const std::string& examples) {
  CLI::App& app = *app_.add_subcommand(name, description)->group(command_heading);
  Command& below = *commands_.emplace_back(std::make_unique<Command>(app, console_, examples));
  below.option(
      "--max-memory", "SIZE", [](const std::string& text) { set_max_memory(parse_bytes(text)); },
      "Maximum memory to use, e.g. 512M or 2G (default: all available memory)");
  return below;
}

void Command::requires_command() {
  app_.require_subcommand(1);
}

Option Command::taken_by(CLI::Option& option,
                         std::function<void(const std::vector<std::string>&)> take) {
  option.check(complaint_of_nothing);
  taken_.push_back({&option, std::move(take), {}});
  return in_group(option);
}

Option Command::in_group(CLI::Option& option) const {
  if (!heading_.empty()) option.group(heading_);
  return Option(option);
}

Option Command::option(const std::string& names, const std::string& value_name, TakeText take,
                       const std::string& help) {
  CLI::Option& option = *app_.add_option(names, help)->type_name(value_name);
  return taken_by(option, [take = std::move(take)](const auto& texts) { take(texts.back()); });
}

Option Command::option(const std::string& names, const std::string& value_name, std::string& value,
                       const std::string& help) {
  return option(
      names, value_name, [&value](const std::string& text) { value = text; }, help);
}

Option Command::repeated_option(const std::string& names, const std::string& value_name,
                                std::function<void(const std::vector<std::string>&)> take,
                                const std::string& help) {
  CLI::Option& option = *app_.add_option(names, help)
                             ->type_name(value_name)
                             ->expected(1, -1)
                             ->allow_extra_args(false);
  return taken_by(option, std::move(take));
}

Option Command::option_with_values(const std::string& names, const std::string& value_name,
                                   std::vector<std::string>& values, const std::string& help) {
  CLI::Option& option =
      *app_.add_option(names, help)->type_name(value_name)->expected(1, -1)->allow_extra_args();
  return taken_by(option, [&values](const auto& texts) { values = texts; });
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) {
  return in_group(*app_.add_flag(name, value, help));
}

Option Command::argument(const std::string& name, std::string& value, const std::string& help) {
  return option(name, "", value, help);
}

Option Command::argument(const std::string& name, TakeText take, const std::string& help) {
  return option(name, "", std::move(take), help);
}

Option Command::arguments(const std::string& name, std::vector<std::string>& values,
                          const std::string& help) {
  return option_with_values(name, "", values, help);
}

void Command::offer(const Option& option, std::vector<std::string> words) {
  const auto taken = std::ranges::find_if(
      taken_, [&](const Taken& each) { return each.option->get_name() == option.name(); });
  taken->offered = std::move(words);
}

Option add_output_options(Command& command, const std::string& value_name,
                          std::function<void(const std::vector<std::string>&)> take,
                          const std::string& help) {
  return command.repeated_option(std::string("-o,--output,") + other_name_of_output, value_name,
                                 std::move(take), help);
}

int Command::run_named(const Console& console) const {
  for (const Taken& taken : taken_) {
    if (taken.option->count() == 0) continue;
    about_option(taken.option->get_name(), [&] { taken.take(taken.option->results()); });
  }
  if (answers_on_standard_output_) expect_standard_output();
  for (const auto& below : commands_) {
    if (below->app_.parsed()) return below->run_named(console);
  }
  return run_(console);
}

CompletedOption Command::completed(const OptionText& option) const {
  const auto taken = std::ranges::find_if(
      taken_, [&](const Taken& each) { return each.option->get_name() == name_of(option); });
  if (taken == taken_.end()) return app::completed(option, {}, false);
  if (!taken->offered.empty()) return app::completed(option, taken->offered, false);
  const std::optional<UnknownName> refusal = refusal_of(taken->take, no_word);
  if (!refusal) return app::completed(option, {}, false);
  // Of a list, the part behind a word is refused by itself.
  const std::optional<UnknownName> of_list =
      refusal_of(taken->take, refusal->names().front() + "," + no_word);
  return app::completed(option, refusal->names(), of_list && of_list->name() == no_word);
}

CompletionTable Command::completion_table() const {
  const CommandText text = text_of(app_);
  CompletionTable table{{text.path, text.summary, {}}};
  for (const OptionText& option : text.options) table[0].options.push_back(completed(option));
  for (const auto& below : commands_) {
    CompletionTable more = below->completion_table();
    table.insert(table.end(), more.begin(), more.end());
  }
  return table;
}

}  // namespace fathom::app
