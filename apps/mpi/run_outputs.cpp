#include "apps/mpi/run_outputs.h"

#include "fathom/camera/camera_files.h"

namespace fathom::app {

RunOutputs::RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras)
    : traffic_(arguments.traffic), of_render_(arguments.render, cameras) {
  of_render_.write_cameras(to_json(cameras) + "\n");
}

void RunOutputs::commit(const std::vector<MapTraffic>& traffic, int ranks) {
  of_render_.commit();
  traffic_.finish(as_json(traffic, ranks));
}

}  // namespace fathom::app
