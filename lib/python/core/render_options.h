#pragma once

#include <functional>
#include <string>

#include "fathom/render.h"

namespace fathom::python {

/// One of Python's names, which it has checked.
Cull cull_named(const std::string& name);

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads,
                         const std::function<void(double)>& progress);

}  // namespace fathom::python
