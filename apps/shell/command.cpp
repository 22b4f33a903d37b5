#include "apps/shell/command.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "apps/shell/about_option.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"

namespace fathom::app {
namespace {

constexpr const char* version_line = "fathom " FATHOM_VERSION;

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
  app.add_flag("--quiet", console.quiet, "No warnings and no progress");
  app.footer("Examples:\n" + examples);
}

Command::~Command() = default;

Command& Command::command(const std::string& name, const std::string& description,
                          const std::string& examples) {
  CLI::App& app = *app_.add_subcommand(name, description);
  Command& below = *commands_.emplace_back(std::make_unique<Command>(app, console_, examples));
  below.option(
      "--max-memory", "SIZE", [](const std::string& text) { set_max_memory(parse_bytes(text)); },
      "Memory that it may take, as 512M or 2G (default: all that there is)");
  return below;
}

void Command::requires_command() {
  app_.require_subcommand(1);
}

Option Command::taken_by(CLI::Option& option,
                         std::function<void(const std::vector<std::string>&)> take) {
  option.check(complaint_of_nothing);
  taken_.push_back({&option, std::move(take)});
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

Option Command::option_with_values(const std::string& names, const std::string& value_name,
                                   std::vector<std::string>& values, const std::string& help) {
  CLI::Option& option =
      *app_.add_option(names, help)->type_name(value_name)->expected(1, -1)->allow_extra_args();
  return taken_by(option, [&values](const auto& texts) { values = texts; });
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) {
  return Option(*app_.add_flag(name, value, help));
}

Option Command::argument(const std::string& name, std::string& value, const std::string& help) {
  return option(name, "", value, help);
}

Option Command::arguments(const std::string& name, std::vector<std::string>& values,
                          const std::string& help) {
  return option_with_values(name, "", values, help);
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

}  // namespace fathom::app
