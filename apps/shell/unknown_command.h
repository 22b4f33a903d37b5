#pragma once

#include <string>
#include <vector>

namespace fathom::app {

/// The message for a command that does not exist, with the one of these that it resembles.
std::string unknown_command(const std::string& name, const std::vector<std::string>& existing);

}  // namespace fathom::app
