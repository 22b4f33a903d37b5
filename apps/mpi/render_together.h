#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/shared_scene.h"
#include "apps/mpi/tiles_together.h"
#include "apps/mpi/traffic.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"

namespace fathom::app {

/// `fathom-mpi render`, in every rank of a run. Returns the exit status, the same in all of them.
int render_together(const MpiArguments& arguments, const Console& console);

/// The same for a scene that is there, and cameras. All ranks have the same ones.
int render_scene_together(const MpiArguments& arguments, const SharedScene& scene,
                          const std::vector<Camera>& cameras, const Console& console);

/// How many rows a chunk has, of a map that is put together from bands of rows; nullopt where all
/// rows go to the first rank.
std::optional<std::uint32_t> rows_of_chunk(const MapPlan& plan);

/// Makes the map of a camera, from the triangles of all ranks to a file. Called by all ranks.
/// `outputs`  of the first rank;  `number`: of the camera
/// `traffic`  gets the costs
/// `report`   gets the statistics of the map, in every rank and summed over all ranks; everything
///            else only in the first rank
void make_map_together(const JobTogether& job, const Camera& camera, RenderOutputs* outputs,
                       std::size_t number, const std::function<void(double)>& progress,
                       MapTraffic& traffic, MapReport& report);

}  // namespace fathom::app
