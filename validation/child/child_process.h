#pragma once

#include <functional>
#include <string>

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

}  // namespace fathom::validation
