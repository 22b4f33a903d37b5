#include "apps/shell/program.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "apps/shell/exit_status.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/output_file.h"
#include "apps/shell/signals.h"
#include "apps/shell/standard_streams.h"
#include "fathom/numeric/errors.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

int report(ExitStatus status, const std::string& message) {
  have_the_last_word();
  if (may_speak()) Console::error(message);
  return status;
}

/// Where the library names a setting, the user gave an option of that name.
std::string message_of(const Error& error) {
  std::string message = error.what();
  if (error.setting().empty()) return message;
  std::string option = "--" + error.setting();
  std::replace(option.begin(), option.end(), '_', '-');
  return option + message.substr(error.setting().size());
}

/// What the machine refuses is nobody's bug. Where it is not known what was asked of it, an output
/// is to blame for what only outputs meet with.
ExitStatus status_of(const std::error_code& code) {
  for (const std::errc refusal : {std::errc::no_space_on_device, std::errc::read_only_file_system,
                                  std::errc::file_too_large, std::errc::broken_pipe}) {
    if (code == refusal) return unwritable_output;
  }
  return unusable_input;
}

/// "PATH: why", where a path is known.
std::string said_by(const std::system_error& error) {
  const std::string why = error.code().message();
  const auto* const about = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (about != nullptr && !about->path1().empty()) return about->path1().string() + ": " + why;
  return "the system refuses: " + why;
}

/// Says so and ends the program as it stands. What was to be written has been taken back on the way here;
/// threads that oneTBB could start, when the system refused it another one, may still be running, and what
/// a program does when it leaves, destroying what they use, would bring them down with a line of their own.
[[noreturn]] void leave_without_threads() {
  std::_Exit(report_lack_of_threads());
}

int run_reporting(const std::function<int()>& run) {
  try {
    open_missing_streams();
    handle_signals();
    stay_within_control_group();
    return run();
  } catch (const UsageError& error) {
    return report(wrong_usage, message_of(error));
  } catch (const InputError& error) {
    return report(unusable_input, message_of(error));
  } catch (const OutputError& error) {
    return report(unwritable_output, message_of(error));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::length_error&) {
    throw;
  } catch (const std::system_error& error) {  // filesystem_error is one
    if (is_lack_of_threads(error)) leave_without_threads();
    if (error.code() == std::errc::not_enough_memory) return report_out_of_memory();
    return report(status_of(error.code()), said_by(error));
  } catch (const std::exception& error) {
    if (is_lack_of_threads(error)) leave_without_threads();
    return report(internal_error, std::string("unexpected: ") + error.what());
  }
}

/// Also a message takes memory: where there is none left for it, that is the message.
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
