#pragma once

#include <vector>

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/shared_scene.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"

namespace fathom::app {

/// `fathom-mpi render`, in every rank of a run. Returns the exit status, the same in all of them.
int render_together(const MpiArguments& arguments, const Console& console);

/// The same for a scene that is there, and cameras. All ranks have the same ones.
int render_scene_together(const MpiArguments& arguments, const SharedScene& scene,
                          const std::vector<Camera>& cameras, const Console& console);

}  // namespace fathom::app
