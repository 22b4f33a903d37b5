#pragma once

#include "apps/shell/command.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// `--cull`
void add_cull_option(Command& command, Cull& cull);

}  // namespace fathom::app
