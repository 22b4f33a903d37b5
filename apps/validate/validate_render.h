#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// `validate --render`: only draws, and writes what the renderer drew as a map of ours. Returns the
/// exit status.
int validate_render(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
