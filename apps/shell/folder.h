#pragma once

#include <filesystem>

namespace fathom::app {

/// Makes a folder where there is none yet. Fails with OutputError.
void make_folder(const std::filesystem::path& folder);

}  // namespace fathom::app
