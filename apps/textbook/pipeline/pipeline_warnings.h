#pragma once

#include "apps/shell/console.h"
#include "fathom/pipeline/geometry/window_transform.h"

namespace fathom::app {

/// Warns of a viewport that stretches the picture, and of windows that leave nothing of the image.
inline void warn_of_windows(const Camera& camera, const pipeline::PipelineOptions& stages,
                            const Console& console) {
  if (pipeline::is_stretched(camera, stages))
    console.warn("the viewport's width : height is not the camera's: the picture is stretched");
  if (pipeline::drawable_window(camera, stages).is_empty())
    console.warn("viewport and scissor box leave no pixel of the image: the map is background");
}

}  // namespace fathom::app
