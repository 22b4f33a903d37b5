#pragma once

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/rank_memory.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/shared_scene.h"
#include "apps/render/render_plan.h"
#include "apps/shell/console.h"

namespace fathom::app {

/// What a run is asked for, and what all its maps are made from.
struct JobTogether {
  const MpiArguments& arguments;
  const Ranks& ranks;
  const Console& console;
  const MapPlan& plan;
  const SharedScene& scene;
  const RankMemory& memory;
};

}  // namespace fathom::app
