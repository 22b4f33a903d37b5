#pragma once

#include <cstdint>
#include <string>

namespace fathom::bench {

/// The machine on which measurements were made.
struct Machine {
  /// "AMD EPYC 9R14"; "unknown" if the system does not say.
  std::string processor;
  int processors = 0;
  std::uint64_t memory_bytes = 0;
  /// Kernel and distribution.
  std::string system;
  std::string compiler;
};

Machine this_machine();

/// The first line of the tables of `bench`; ends with an empty line.
std::string machine_line(const Machine& machine);

}  // namespace fathom::bench
