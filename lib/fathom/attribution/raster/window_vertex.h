#pragma once

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/raster/clip_vertex.h"

namespace fathom::attribution {

/// A corner in window coordinates, and how far the renderer's own may be from them.
///
/// Frame    x, y in pixels from the top left corner of the image, y down.
struct WindowVertex {
  /// z is the window depth; q what a fragment shader makes its own depth of, without a unit; depth
  /// what z means, in scene units.
  double x = 0, y = 0, z = 0, q = 0, depth = 0;
  /// Errors in either direction; those of x and y before the corner is snapped and after.
  double error_x = 0, error_y = 0, error_z = 0, error_q = 0, snapped_x = 0, snapped_y = 0;
  /// How far the image's upper or lower border is from the corner, whichever is farther.
  double from_border = 0;
  /// As of the ClipVertex.
  unsigned borders = 0;
};

/// Needs    vertex.w > 0. Leaves `depth` at 0.
WindowVertex to_window(const ClipVertex& vertex, const Camera& camera, const RasterModel& model);

}  // namespace fathom::attribution
