#pragma once

#include <cstddef>
#include <string>

#include "apps/shell/command_text.h"

namespace fathom::app {

/// The help of a command, as plain text of at most `width` columns; examples may be wider.
std::string help_page(const CommandText& command, std::size_t width);

/// The columns that help on standard output may take: those of the terminal from 60 to 100, and 80
/// where there is none.
std::size_t help_width();

}  // namespace fathom::app
