#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// `fathom depth encode | decode | resolution | codes`: depth formats as a calculator.
void add_depth(Command& program);

}  // namespace fathom::app
