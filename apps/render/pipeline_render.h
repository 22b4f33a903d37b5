#pragma once

#include "apps/render/render_arguments.h"

namespace fathom::app {

/// `fathom render --engine pipeline`.
int run_pipeline_render(const RenderArguments& arguments, const Console& console);

}  // namespace fathom::app
