#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fathom::app {

/// A command that is a program of its own, because of what it is built from. scripts/fathom builds
/// it when it is first asked for.
struct Companion {
  std::string command;      ///< "clip"
  std::string program;      ///< "fathom-textbook"
  std::string description;  ///< as `fathom --help` shows it

  /// A program with a single command does not take that command's name: its own name says it.
  [[nodiscard]] bool takes_name() const { return program != "fathom-" + command; }
};

/// Where the program of this name would lie: beside this one, whichever way this one was started.
/// Empty where the system does not tell.
std::filesystem::path companion_path(const std::string& program);

/// Starts the program of this name that lies beside this one, in place of this process. Returns
/// where there is no such program.
/// Fails    UsageError where it is there but cannot be started.
void start_companion(const std::string& program, const std::vector<std::string>& arguments);

/// What the companion with this command answers on standard output to the command's name, where it
/// takes that, and these arguments. Nothing where it is not built or fails; it says why itself.
std::optional<std::string> answer_of(const Companion& companion,
                                     const std::vector<std::string>& arguments);

/// The message where a companion does not lie beside this program: `what` needs it ("'clip'"), and
/// scripts/fathom builds it where it is given `how` ("clip").
std::string not_built(const std::string& what, const std::string& program, const std::string& how);

}  // namespace fathom::app
