#pragma once

#include <string>

#include "fathom/render.h"

namespace fathom::python {

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads);

}  // namespace fathom::python
