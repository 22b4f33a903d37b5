#include "apps/bench/machine_line.h"

#include <fmt/core.h>

namespace fathom::app {

std::string machine_line(const bench::Machine& machine) {
  return fmt::format("{}, {} processor{}, {:.1f} GiB; {}; {}\n\n", machine.processor,
                     machine.processors, machine.processors == 1 ? "" : "s",
                     static_cast<double>(machine.memory_bytes) / (1 << 30), machine.system,
                     machine.compiler);
}

}  // namespace fathom::app
