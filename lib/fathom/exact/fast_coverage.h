#pragma once

#include "fathom/exact/coverage.h"

namespace fathom {

/// Channel A by the fast engine: fills width × height values, row by row, 0 where nothing is
/// covered. Adds to `statistics` how decisions were made.
void write_fast_coverage(const CoverageFrame& frame, float* values, RenderStatistics& statistics);

}  // namespace fathom
