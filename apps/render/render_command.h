#pragma once

#include <functional>

#include "apps/render/render_arguments.h"

namespace fathom::app {

using Render = std::function<int(const RenderArguments&, const Console&)>;

/// `fathom render`. Each program that has it brings what renders with the engines.
void add_render(Command& program, const Render& by_exact_engine, const Render& by_pipeline);

}  // namespace fathom::app
