#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// `validate --against`: has renderers draw scenes and compares every map with the truth. Returns
/// the exit status, as ValidationReport::finish().
int validate_against(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
