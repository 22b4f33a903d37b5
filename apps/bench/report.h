#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/bench/measurement.h"

/// The reports of `fathom bench`, and the machine that they describe.
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

/// All renderers on one scene, size and number of threads.
struct Comparison {
  Plan plan;
  std::uint64_t triangles = 0;
  std::vector<Measurement> measurements;
};

/// A heading line, then a table with a row for each renderer: times in milliseconds, the median
/// also as a multiple of the fast engine's, peak memory in MiB, and the resulting triangles and
/// pixels of the image per second. Ends with an empty line.
std::string table(const Comparison& comparison);

/// {"machine": …, "results": [ … ]}, explained in docs/performance.md. Ends without a newline.
std::string to_json(const Machine& machine, const std::vector<Comparison>& comparisons);

}  // namespace fathom::bench
