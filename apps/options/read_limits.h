#pragma once

#include <cstdint>
#include <filesystem>

#include "apps/shell/command.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom::app {

/// `--outside-files --confine --max-expansion`: what files of others may make a command open, and
/// how much memory they may fill. Every command that reads a scene takes them.
struct ReadLimits {
  bool outside_files = false;
  std::filesystem::path confine;
  std::uint64_t max_expansion = ReadOptions().max_expansion;

  void add_to(Command& command);
  /// With the limits, and with the program that reads foreign formats; all else by default.
  [[nodiscard]] ReadOptions read_options() const;
};

}  // namespace fathom::app
