#pragma once

#include "apps/mpi/mpi_arguments.h"
#include "apps/shell/console.h"

namespace fathom::app {

/// `fathom-mpi render`, in every rank of a run. Returns the exit status, the same in all of them.
int render_together(const MpiArguments& arguments, const Console& console);

}  // namespace fathom::app
