#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fathom::app {

/// A command that is a separate program, because it has more dependencies. scripts/fathom builds it
/// on first use.
struct Companion {
  std::string_view command;      ///< "clip"
  std::string_view program;      ///< "fathom-textbook"
  std::string_view description;  ///< as `fathom --help` shows it

  /// A program with a single command does not take the command's name as an argument.
  [[nodiscard]] bool takes_name() const { return program != "fathom-" + std::string(command); }
};

/// Path of the program of this name in the folder of this program, however this one was started.
/// Empty if the system does not report that folder.
std::filesystem::path companion_path(std::string_view program);

/// Replaces this process by the program of this name in the same folder. Returns if there is no
/// such program.
/// Fails    UsageError if the program exists but cannot be started.
void start_companion(std::string_view program, const std::vector<std::string>& arguments);

/// Standard output of the companion with this command, called with the command's name, if it takes
/// the name, and these arguments. Nothing if it is not built or fails; it prints the reason itself.
std::optional<std::string> answer_of(const Companion& companion,
                                     const std::vector<std::string>& arguments);

/// The message about a companion that is not in this program's folder: `what` needs it ("'clip'"),
/// and `scripts/fathom HOW` builds it ("clip").
std::string not_built(std::string_view what, std::string_view program, std::string_view how);

}  // namespace fathom::app
