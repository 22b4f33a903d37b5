#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/shell/command_text.h"

namespace fathom::app {

/// The help of a command, as plain text of at most `width` columns; examples may be wider.
std::string help_page(const CommandText& command, std::size_t width);

/// The help of a command on one screen of 40 lines: the help_page() if it fits, else the names of
/// all options and the first example. A command with other commands below it keeps its help_page().
std::string help_on_a_screen(const CommandText& command, std::size_t width);

/// Width of help on standard output: the terminal's width, limited to 60 to 100 columns, or 80
/// without a terminal.
std::size_t help_width();

/// "fathom-camera-orbit", under which `man` finds the page of a command.
std::string man_name(const std::vector<std::string>& path);

/// The page of a command in section 1, in roff. It is dated by SOURCE_DATE_EPOCH (seconds since
/// 1970) where that is set, as packages that are built twice want it, and by today elsewhere.
std::string man_page(const CommandText& command, const std::string& version);

}  // namespace fathom::app
