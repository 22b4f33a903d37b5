#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fathom/pipeline/trace.h"

namespace fathom::app {

/// What goes into each stage of the pipeline and what comes out.
std::string as_text(const pipeline::PrimitiveTrace& trace);
nlohmann::ordered_json to_json(const pipeline::PrimitiveTrace& trace);

}  // namespace fathom::app
