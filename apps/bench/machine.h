#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fathom::bench {

/// The machine on which measurements were made.
struct Machine {
  /// "AMD EPYC 9R14"; "unknown" if the system does not report it.
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

/// A machine as reports name it: processor, processors, memory_bytes, system, compiler.
nlohmann::ordered_json to_json(const Machine& machine);

/// Processors that this process may run on.
int processor_count();

/// Restricts this process and its threads to at most `count` processors, on separate cores as far
/// as there are enough, so that all renderers have the same resources however many threads they
/// start. Does nothing if the system does not allow it.
void keep_to_processors(int count);

}  // namespace fathom::bench
