#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/bench/machine.h"

namespace fathom::bench {

/// A machine as reports name it: processor, processors, memory_bytes, system, compiler.
nlohmann::ordered_json to_json(const Machine& machine);

}  // namespace fathom::bench
