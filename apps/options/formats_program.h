#pragma once

#include <filesystem>

namespace fathom::app {

/// Where fathom-formats lies: beside this program. Where it is not there, the program that the
/// environment names in FATHOM_PROVIDE_FORMATS is run first, to put it there: scripts/fathom names
/// one that installs what it needs and builds it. What that program says goes to standard error.
std::filesystem::path formats_program();

}  // namespace fathom::app
