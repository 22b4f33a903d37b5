#pragma once

#include <string>
#include <vector>

namespace fathom::app {

/// Starts the program `fathom-NAME` that lies beside this one, with the arguments behind NAME, in
/// place of this process. Returns where there is no such program.
/// Fails    UsageError where it is there but cannot be started.
void start_companion(const std::string& name, const std::vector<char*>& arguments);

/// The message for a command that does not exist: how to build it, or the nearest name of those
/// that exist.
std::string unknown_command(const std::string& name, const std::vector<std::string>& existing);

}  // namespace fathom::app
