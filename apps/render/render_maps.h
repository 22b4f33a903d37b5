#pragma once

#include "apps/render/render_arguments.h"

namespace fathom::app {

/// `fathom render` with an exact engine: makes a plan of the arguments, then carries it out.
int render_exactly(const RenderArguments& arguments, const Console& console);

}  // namespace fathom::app
