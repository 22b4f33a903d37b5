#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// Adds `directions` to `fathom camera`.
void add_directions(Command& camera);

}  // namespace fathom::app
