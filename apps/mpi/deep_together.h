#pragma once

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/ranks.h"
#include "apps/shell/console.h"

namespace fathom::app {

/// `fathom-mpi render --deep`: every rank has the whole scene and makes a share of the rows, and the
/// first writes what all have made. Called by all ranks. Returns the exit status.
int render_deep_together(const Ranks& ranks, const MpiArguments& arguments, const Console& console);

}  // namespace fathom::app
