#pragma once

#include <functional>
#include <string>

#include "fathom/render.h"

namespace fathom::python {

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads,
                         const std::function<void(double)>& progress);

}  // namespace fathom::python
