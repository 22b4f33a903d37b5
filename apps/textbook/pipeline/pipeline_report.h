#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/options.h"

namespace fathom::app {

/// What `render --engine pipeline --stats` says of a map.
struct PipelineReport {
  std::string map;  ///< the name of the file
  std::uint32_t width = 0, height = 0;
  pipeline::PipelineStatistics statistics;
  std::optional<pipeline::PainterStatistics> painter;
};

/// An object for a single map, a list for several.
std::string as_json(const std::vector<PipelineReport>& maps);

/// Warns of a viewport that stretches the picture, and of windows that leave nothing of the image.
void warn_of_windows(const Camera& camera, const pipeline::PipelineOptions& stages,
                     const Console& console);

}  // namespace fathom::app
