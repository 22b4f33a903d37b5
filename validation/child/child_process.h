#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom::validation {

/// A child process was ended by a signal, took too long or gave an unreadable answer.
class ChildFailure : public InputError {
 public:
  using InputError::InputError;
};

/// Settings of a child process.
struct ChildOptions {
  /// Its name in messages.
  std::string name = "a process to measure in";
  /// The child and its children are ended after so many seconds; 0: never.
  int seconds = 0;
};

/// Runs `work` in a separate process, a fork of this one, and returns its bytes, so that its
/// memory, its threads and the libraries it loads stay separate. It ends when this process does.
///
/// Needs    a process that has started no threads. `work` does not throw.
/// Fails    ChildFailure.
std::string bytes_from_child(const std::function<std::string()>& work, const ChildOptions& options);

/// Standard output and standard error of a program, and its exit status: 127 if the program does
/// not exist, 128 + the signal if a signal ended it.
struct Said {
  std::string text;
  int status = 0;
};

/// Runs a program, found on the PATH, with these arguments, its name first. No shell reads them: a
/// path may have any characters. Nothing is on its standard input.
/// Fails    InputError if it cannot be started for another reason than that it is not there.
Said run_command(const std::vector<std::string>& command);

}  // namespace fathom::validation
