#pragma once

#include <cstdint>
#include <string>

namespace fathom::bench {

/// What measurements were made on.
struct Machine {
  /// "AMD EPYC 9R14", "unknown" where the system does not tell.
  std::string processor;
  int processors = 0;
  std::uint64_t memory_bytes = 0;
  /// Kernel and distribution.
  std::string system;
  std::string compiler;
};

Machine this_machine();

}  // namespace fathom::bench
