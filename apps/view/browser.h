#pragma once

#include <filesystem>
#include <string>

#include "apps/shell/console.h"

namespace fathom::app {

/// A name for a page in a new folder of its own, below $TMPDIR, which only the user can read.
/// Fails    OutputError.
std::filesystem::path new_page_path();

/// Opens a file or an address in the system's browser, by xdg-open or the program of $BROWSER. Does
/// not wait for it. Without $BROWSER and without a display it only warns.
/// Fails    OutputError where there is no such program.
void open_in_browser(const std::string& page, const Console& console);

}  // namespace fathom::app
