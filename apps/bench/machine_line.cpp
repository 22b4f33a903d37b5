#include "apps/bench/machine_line.h"

#include <fmt/core.h>

#include "fathom/text/counted.h"

namespace fathom::app {

std::string machine_line(const bench::Machine& machine) {
  return fmt::format("{}, {}, {:.1f} GiB; {}; {}\n\n", machine.processor,
                     text::counted(machine.processors, "processor"),
                     static_cast<double>(machine.memory_bytes) / (1 << 30), machine.system,
                     machine.compiler);
}

}  // namespace fathom::app
