#pragma once

#include <limits>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/raster/clip_vertex.h"

namespace fathom::attribution {

/// A corner in window coordinates, with bounds on the distance of the renderer's own from them.
///
/// Frame    x, y in pixels from the top left corner of the image, y down.
struct WindowVertex {
  /// z is the window depth; q the quantity from which a fragment shader computes its own depth,
  /// without a unit; depth the depth of z, in scene units.
  double x = 0, y = 0, z = 0, q = 0, depth = 0;
  /// Errors in either direction; the errors of x and y before and after the corner is snapped.
  double error_x = 0, error_y = 0, error_z = 0, error_q = 0, snapped_x = 0, snapped_y = 0;
  /// The distance of the corner from the image's upper or lower border, whichever is farther.
  double from_border = 0;
  /// As of the ClipVertex.
  unsigned borders = 0;
};

/// Needs    vertex.w > 0. Leaves `depth` at 0.
WindowVertex to_window(const ClipVertex& vertex, const Camera& camera, const RasterModel& model);

/// A value that is interpolated over a polygon in the image, z = value + g·(s − corner), with
/// bounds on its errors (docs/validation.md, "Window depth").
///
/// Frame    window, pixels from the top left corner; gradients g per pixel.
struct DepthPlane {
  double x = 0, y = 0, value = 0;  ///< at a corner
  double g_x = 0, g_y = 0;
  /// The error of a value interpolated at a sample inside, from displaced corners and the
  /// evaluation of the plane.
  double error = std::numeric_limits<double>::infinity();
  /// Over the corners.
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  /// False if the plane is unknown, because its corners may lie on a line.
  bool is_known = false;

  [[nodiscard]] double at(double sample_x, double sample_y) const {
    return value + g_x * (sample_x - x) + g_y * (sample_y - y);
  }
};

/// A member of every corner.
using CornerValue = double WindowVertex::*;

/// The plane of `value` through the largest triangle of a polygon's corners; the renderer's own
/// value errs by at most `error` at each corner. The error of the plane is the worst over all
/// triangles of corners, because a renderer may split the polygon. `before_snap`: use the positions
/// of the corners before snapping.
DepthPlane depth_plane(const std::vector<WindowVertex>& corners, CornerValue value,
                       CornerValue error, bool before_snap);

/// Twice the area of a triangle in the image, signed.
double area_of(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

}  // namespace fathom::attribution
