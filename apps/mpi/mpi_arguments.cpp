#include "apps/mpi/mpi_arguments.h"

#include "apps/mpi/rank_memory.h"
#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {

namespace {

std::uint64_t parse_memory(const std::string& text) {
  const std::uint64_t bytes = parse_bytes(text);
  if (bytes < least_rank_memory) throw UsageError("expected at least 128M");
  return bytes;
}

}  // namespace

void MpiArguments::add_to(Command& command) {
  render.add_to(command);
  command.option("--partition", "NAME", into(partition, parse_partition),
                 "How tiles are dealt out to the ranks: load (default: runs of neighbours of about "
                 "the same work), rows or round-robin. The map is the same");
  command.option(
      "--memory", "SIZE", into(memory, parse_memory),
      "How much memory each rank may take beside scenes that it has to read whole: 512M, "
      "2G; at least 128M (default: its share of three quarters of what the machine has). "
      "What does not fit waits in files in the folder that TMPDIR names. The map is the "
      "same");
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
}

}  // namespace fathom::app
