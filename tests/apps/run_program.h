#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fathom::test {

/// How a program ended and what it said. `status` is 128 + the signal if one ended it.
struct Outcome {
  int status = -1;
  std::string out, err;
};

struct RunOptions {
  std::filesystem::path folder = ".";
  /// Text on standard input.
  std::string input;
  /// Limits of the process in bytes: the size of files, the address space.
  std::optional<rlim_t> file_size, memory;
  /// A limit of its processor time; status 152 is that it was ended for it.
  std::optional<rlim_t> seconds;
  /// Called in the process before it becomes the program.
  std::function<void()> prepare;
  /// Run as the user nobody where the test is root, whom permissions do not hold.
  bool as_nobody = false;
};

/// Runs the built `fathom` with these arguments.
Outcome run_fathom(const std::vector<std::string>& arguments, const RunOptions& options = {});
/// Runs any program, found on the PATH.
Outcome run(const std::vector<std::string>& command, const RunOptions& options = {});
/// Starts `fathom` and returns its process id; its output goes to nowhere.
pid_t start_fathom(const std::vector<std::string>& arguments, const RunOptions& options);
/// Waits for a process that start_fathom started; its status as in Outcome.
int wait_for(pid_t process);

/// Debian's Python, which has the packages that the tests use; another may come first on the PATH.
inline const std::string python = "/usr/bin/python3";

/// Where the built program lies.
std::string program_path();

}  // namespace fathom::test
