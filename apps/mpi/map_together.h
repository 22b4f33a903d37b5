#pragma once

#include <functional>
#include <optional>

#include "apps/mpi/tiles_together.h"
#include "apps/mpi/traffic.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_report.h"

namespace fathom::app {

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
