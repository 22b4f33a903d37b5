#include "apps/shell/program.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "apps/shell/exit_status.h"
#include "apps/shell/output_file.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

int report(ExitStatus status, const std::string& message) {
  Console::error(message);
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

int run_reporting(const std::vector<std::string>& arguments,
                  const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions) {
  try {
    remove_outputs_when_interrupted();
    return run_arguments(arguments, commands, companions);
  } catch (const UsageError& error) {
    return report(wrong_usage, message_of(error));
  } catch (const InputError& error) {
    return report(unusable_input, message_of(error));
  } catch (const OutputError& error) {
    return report(unwritable_output, message_of(error));
  } catch (const std::bad_alloc&) {
    return report(unusable_input, "out of memory: the input or the image is too large");
  } catch (const std::length_error&) {
    return report(unusable_input, "out of memory: the input or the image is too large");
  } catch (const std::exception& error) {
    return report(internal_error, std::string("unexpected: ") + error.what());
  }
}

}  // namespace

int program_main(int argc, char** argv, const std::vector<AddCommand>& commands,
                 const std::vector<Companion>& companions) {
  return run_reporting({argv + std::min(argc, 1), argv + argc}, commands, companions);
}

int companion_main(int argc, char** argv, const char* name, const AddCommand& command) {
  std::vector<std::string> arguments{name};
  arguments.insert(arguments.end(), argv + std::min(argc, 1), argv + argc);
  return run_reporting(arguments, {command}, {});
}

}  // namespace fathom::app
