#pragma once

#include <functional>
#include <string>

#include "fathom/numeric/errors.h"

namespace fathom::bench {

/// The process was ended by a signal, took too long or gave no answer.
class ChildFailure : public InputError {
 public:
  using InputError::InputError;
};

/// Runs `work` in a process of its own, a fork of this one, and returns its text: so that its
/// memory, its threads and the libraries it loads are its own.
///
/// Needs    a process that has started no threads.
/// `name` names it in messages. It ends when this process does. After `seconds`, if not 0, it and
/// what it has started are ended.
///
/// Fails    as `work` does, with the same kind of error and message; else ChildFailure.
std::string run_in_child(const std::function<std::string()>& work, int seconds = 0,
                         const std::string& name = "a process to measure in");

}  // namespace fathom::bench
