#pragma once

#include <vector>

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/traffic.h"
#include "apps/render/render_outputs.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera.h"

namespace fathom::app {

/// What a run writes, all of it by its first rank: what one process would write, and what ranks have
/// sent each other.
class RunOutputs {
 public:
  /// Writes the cameras.
  /// Fails    as RenderOutputs and TextOutput.
  RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras);

  [[nodiscard]] RenderOutputs& of_render() { return of_render_; }

  /// Puts all of them in their places. `traffic`: of all maps.
  void commit(const std::vector<MapTraffic>& traffic, int ranks);

 private:
  TextOutput traffic_;
  RenderOutputs of_render_;
};

}  // namespace fathom::app
