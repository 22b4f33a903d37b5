#pragma once

#include "apps/mpi/partition.h"
#include "apps/render/render_arguments.h"

namespace fathom::app {

/// The arguments of `fathom-mpi render`: those of `fathom render`, and one more.
struct MpiArguments {
  RenderArguments render;
  Partition partition = Partition::load;
  std::string traffic;

  void add_to(Command& command);
};

/// Refuses what several ranks cannot do yet, before any work.
/// Fails    UsageError.
void refuse_what_is_missing(const RenderArguments& arguments);

}  // namespace fathom::app
