#pragma once

#include "apps/render/render_arguments.h"

namespace fathom::app {

/// `fathom render --engine pipeline`: makes a plan of the arguments, then carries it out.
int render_by_pipeline(const RenderArguments& arguments, const Console& console);

}  // namespace fathom::app
