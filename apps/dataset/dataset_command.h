#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// fathom dataset maps | colmap | … : the maps of a whole data set, in its own layout.
void add_dataset(Command& program);

}  // namespace fathom::app
