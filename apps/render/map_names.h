#pragma once

#include <string>
#include <vector>

namespace fathom::app {

/// The names of the outputs that an option's pattern means: `maps/{index:04}.exr`, one for each
/// camera of a path; a single camera needs no {index}.
/// Fails    UsageError, naming the option.
std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          std::size_t cameras);

}  // namespace fathom::app
