#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/machine.h"
#include "apps/bench/measurement.h"

/// The reports of `fathom bench`.
namespace fathom::bench {

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
