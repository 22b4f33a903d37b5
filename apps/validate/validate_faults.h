#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// `validate --faults --against …`: faults of the catalogue in maps of real renderers. Prints what is
/// not found or wrongly named, writes faults.json and faults.md, and returns the exit status:
/// answer_is_no where something is found in a right map, or a fault that is large enough is not
/// found and rightly named; unusable_input where a renderer did not draw.
int validate_faults(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
