#include "apps/mpi/mpi_arguments.h"

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"

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
  command.begin_group("Ranks");
  command.option("--partition", "NAME", into(partition, parse_partition),
                 "Distribute the tiles by load (default: neighbouring tiles with about equal "
                 "work), rows or round-robin. The map does not depend on it");
  command.option(
      "--memory", "SIZE", into(memory, parse_memory),
      "Maximum memory of each rank, e.g. 512M or 2G, at least 128M; scenes that a rank has to read "
      "whole, and 17 bytes per pixel of a camera with a lens, come on top (default: an equal share "
      "of three quarters of the machine's memory). Data that does not fit is kept in files in "
      "$TMPDIR. The map does not depend on it");
  command.option("--traffic", "FILE", traffic,
                 "Write the bytes that ranks sent to each other and their times, one line of JSON "
                 "per map; '-' is standard output");
}

void refuse_what_is_missing(const RenderArguments& a) {
  if (a.engine != EngineName::fast)
    throw UsageError("--engine: fathom-mpi supports only --engine fast");
  if (a.stream) {
    throw UsageError("--stream: fathom-mpi leaves binary STL and PLY in their files anyway");
  }
}

}  // namespace fathom::app
