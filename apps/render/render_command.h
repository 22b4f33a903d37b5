#pragma once

#include <functional>

#include "apps/render/render_arguments.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"

namespace fathom::app {

using Render = std::function<int(const RenderArguments&, const Console&)>;

/// `fathom render`. Each program that has it brings what renders with the engines.
void add_render(Command& program, const Render& by_exact_engine, const Render& by_pipeline);

/// Make a plan of the arguments, then carry it out: `fathom` has the exact engines
/// (render_maps.cpp), fathom-textbook the pipeline (textbook/pipeline/pipeline_render.cpp).
int render_exactly(const RenderArguments& arguments, const Console& console);
int render_by_pipeline(const RenderArguments& arguments, const Console& console);

}  // namespace fathom::app
