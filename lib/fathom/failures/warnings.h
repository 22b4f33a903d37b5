#pragma once

#include <string>
#include <vector>

namespace fathom {

/// What a reader noticed that is not an error: one line each, with a count if it recurs.
using Warnings = std::vector<std::string>;

}  // namespace fathom
