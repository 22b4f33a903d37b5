#include "apps/bench/measurement.h"
#include "fathom/failures/errors.h"

namespace fathom::bench {

bool masked_occlusion_culling_is_built() {
  return false;
}

std::vector<Measurement> measure_masked_occlusion_culling(BenchScene&& /*bench*/,
                                                          const Plan& /*plan*/,
                                                          std::uint64_t /*idle_bytes*/) {
  throw UsageError(
      "masked-occlusion-culling is not built in: -DFATHOM_MASKED_OCCLUSION_CULLING=FOLDER builds "
      "with a clone of it");
}

}  // namespace fathom::bench
