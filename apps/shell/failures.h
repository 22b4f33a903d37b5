#pragma once

#include <string>

#include "fathom/failures/errors.h"

namespace fathom::app {

/// Exit statuses of every command.
enum ExitStatus : int {
  done = 0,
  answer_is_no = 1,
  wrong_usage = 2,
  unusable_input = 3,
  unwritable_output = 4,
  internal_error = 70,
  interrupted = 130,
};

/// What `call` returns. A UsageError of it gets the option before it: "--size: 'big' is not …".
template <class Call>
auto about_option(const std::string& option, const Call& call) {
  try {
    return call();
  } catch (const UsageError& error) {
    throw UsageError(option + ": " + error.what());
  }
}

/// What `call` returns. An OutputError of it gets the name of the output before it:
/// "map.png: pixel (3, 5): …".
template <class Call>
auto about_output(const std::string& name, const Call& call) {
  try {
    return call();
  } catch (const OutputError& error) {
    throw OutputError(name + ": " + error.what());
  }
}

}  // namespace fathom::app
