#include "apps/mpi/mpi_arguments.h"

#include "fathom/numeric/errors.h"

namespace fathom::app {

void MpiArguments::add_to(Command& command) {
  render.add_to(command);
  command.option("--partition", "NAME", into(partition, parse_partition),
                 "How tiles are dealt out to the ranks: load (default: runs of neighbours of about "
                 "the same work), rows or round-robin. The map is the same");
  command.option(
      "--traffic", "FILE", traffic,
      "Write what the ranks have sent to each other and how long they have drawn, a line of "
      "JSON for each map; '-' is standard output");
}

void refuse_what_is_missing(const RenderArguments& a) {
  if (a.engine != EngineName::fast) throw UsageError("--engine: fathom-mpi has the fast one alone");
  if (a.stream) {
    throw UsageError("--stream: fathom-mpi leaves binary STL and PLY in their files anyway");
  }
  const char* const missing = a.deep                   ? "--deep"
                              : !a.mattes().empty()    ? "--cryptomatte"
                              : a.samples              ? "--samples"
                              : a.depth_buffer.storage ? "--depth-format"
                              : a.verified_pixels      ? "--verify"
                              : !a.statistics.empty()  ? "--stats"
                                                       : nullptr;
  if (missing != nullptr)
    throw UsageError(std::string(missing) + " is not for fathom-mpi yet; 'fathom render' has it");
}

}  // namespace fathom::app
