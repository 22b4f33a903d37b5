#pragma once

#include <string>

#include "fathom/pipeline/trace.h"

namespace fathom::app {

/// What goes into each stage of the pipeline and what comes out.
std::string as_text(const pipeline::TriangleTrace& trace);
std::string as_json(const pipeline::TriangleTrace& trace);

}  // namespace fathom::app
