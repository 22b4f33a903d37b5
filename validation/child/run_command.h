#pragma once

#include <string>
#include <vector>

namespace fathom::validation {

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
