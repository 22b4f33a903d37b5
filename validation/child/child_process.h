#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom::validation {

/// A process of its own was ended by a signal, took too long or gave no answer that is understood.
class ChildFailure : public InputError {
 public:
  using InputError::InputError;
};

/// How a process of its own is run.
struct ChildOptions {
  /// What it is called in messages.
  std::string name = "a process to measure in";
  /// It and what it has started are ended after so many seconds; 0: never.
  int seconds = 0;
};

/// Runs `work` in a process of its own, a fork of this one, and returns its bytes: so that its
/// memory, its threads and the libraries it loads are its own. It ends when this process does.
///
/// Needs    a process that has started no threads. `work` does not throw.
/// Fails    ChildFailure.
std::string bytes_from_child(const std::function<std::string()>& work, const ChildOptions& options);

/// What a program printed, on standard output and on standard error, and its exit status: 127 where
/// there is no such program, 128 + the signal where one ended it.
struct Said {
  std::string text;
  int status = 0;
};

/// Runs a program, found on the PATH, with these arguments, its name first. No shell reads them: a
/// path may have any characters. Nothing is on its standard input.
/// Fails    InputError if it cannot be started for another reason than that it is not there.
Said run_command(const std::vector<std::string>& command);

}  // namespace fathom::validation
