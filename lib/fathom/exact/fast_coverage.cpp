#include "fathom/exact/fast_coverage.h"

#include "fathom/exact/coverage_image.h"

namespace fathom {

void write_fast_coverage(const CoverageFrame& frame, float* values, RenderStatistics& statistics) {
  statistics.coverage += write_coverage(frame, values);
}

}  // namespace fathom
