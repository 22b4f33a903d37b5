#pragma once

#include <functional>
#include <string>

namespace fathom::bench {

/// Runs `work` in a process of its own, a fork of this one, and returns its text: so that its
/// memory, its threads and the libraries it loads are its own.
///
/// Needs    a process that has started no threads.
/// Fails    as `work` does, with the same kind of error and message; InputError where the process
///          was ended by a signal.
std::string run_in_child(const std::function<std::string()>& work);

}  // namespace fathom::bench
