#pragma once

#include <filesystem>
#include <string>

namespace fathom::app {

/// A name for a page in a new folder of its own, below $TMPDIR, which only the user can read.
/// Fails    OutputError.
std::filesystem::path new_page_path();

/// Has the system's browser open a file or an address, by xdg-open or what $BROWSER names. Does not
/// wait for it.
/// Fails    OutputError where there is no such program.
void open_in_browser(const std::string& page);

}  // namespace fathom::app
