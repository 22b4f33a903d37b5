#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// `validate --colour`: has VTK draw lit scenes and holds its pictures and the pipeline's against
/// what the formulas allow each (validation/colour). Returns the exit status: answer_is_no where a
/// pixel is unexplained, unusable_input where VTK did not draw or a scene cannot be compared.
int validate_colours(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
