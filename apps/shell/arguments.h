#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/companion.h"

namespace fathom::app {

using AddCommand = std::function<void(Command& program)>;

/// Does what the arguments of a program with these commands ask for: runs the command that they
/// name, shows help or the version, or starts the companion that has the command.
/// Fails    UsageError where they make no sense; as the command fails.
int run_arguments(const std::vector<std::string>& arguments,
                  const std::vector<AddCommand>& commands,
                  const std::vector<Companion>& companions);

}  // namespace fathom::app
