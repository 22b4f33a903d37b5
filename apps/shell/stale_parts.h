#pragma once

#include <filesystem>

namespace fathom::app {

/// Removes from a folder what programs that were killed have left of their outputs: regular files of
/// this user that are called as parts are (part_names.h) and that no living process holds a lock
/// on. Once for each folder; what cannot be removed stays.
void remove_stale_parts(const std::filesystem::path& folder);

}  // namespace fathom::app
