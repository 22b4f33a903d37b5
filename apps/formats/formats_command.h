#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// `fathom formats`: the libraries that read foreign formats, and the suffixes of their files.
void add_formats(Command& program);

}  // namespace fathom::app
