#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// `validate --map`: compares a map that another renderer made with the truth. Returns the exit
/// status, as ValidationReport::finish().
int validate_map(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
