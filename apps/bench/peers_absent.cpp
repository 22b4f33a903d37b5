#include "apps/bench/measurement.h"
#include "fathom/failures/errors.h"

namespace fathom::bench {
namespace {

[[noreturn]] void refuse(const char* peer) {
  throw UsageError(std::string(peer) +
                   " is not built in: 'scripts/fathom bench' in a clone of Fathom installs it and "
                   "builds with it (-DFATHOM_PEERS=ON)");
}

}  // namespace

bool peers_are_built() {
  return false;
}

std::vector<Measurement> measure_vtk(BenchScene /*bench*/, const Plan& /*plan*/,
                                     std::uint64_t /*idle_bytes*/) {
  refuse("vtk");
}

std::vector<Measurement> measure_embree(BenchScene /*bench*/, const Plan& /*plan*/, bool /*robust*/,
                                        std::uint64_t /*idle_bytes*/) {
  refuse("embree");
}

}  // namespace fathom::bench
