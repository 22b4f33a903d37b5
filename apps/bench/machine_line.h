#pragma once

#include <string>

#include "apps/bench/machine.h"

namespace fathom::app {

/// What the tables of `bench` begin with; ends with an empty line.
std::string machine_line(const bench::Machine& machine);

}  // namespace fathom::app
