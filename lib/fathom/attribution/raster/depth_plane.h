#pragma once

#include <limits>
#include <vector>

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

/// A value that is interpolated over a polygon in the image, z = value + g·(s − corner), and what
/// bounds its errors (docs/validation.md, "Window depth").
///
/// Frame    window, pixels from the top left corner; gradients g per pixel.
struct DepthPlane {
  double x = 0, y = 0, value = 0;  ///< at a corner
  double g_x = 0, g_y = 0;
  /// Of a value that is interpolated at a sample inside: corners displaced, plane evaluated.
  double error = std::numeric_limits<double>::infinity();
  /// Over the corners.
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  /// False: the plane could not be told, its corners may lie on a line.
  bool is_known = false;

  [[nodiscard]] double at(double sample_x, double sample_y) const {
    return value + g_x * (sample_x - x) + g_y * (sample_y - y);
  }
};

/// A number that every corner has.
using CornerValue = double WindowVertex::*;

/// The plane of `value`, of which the renderer's own is at most `error` off at each corner, through
/// the largest triangle of a polygon's corners; its error is the worst over all of them, as a
/// renderer may split the polygon. `before_snap`: corners are where they were before they were
/// snapped.
DepthPlane depth_plane(const std::vector<WindowVertex>& corners, CornerValue value,
                       CornerValue error, bool before_snap);

/// Twice the area of a triangle in the image, signed.
double area_of(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

}  // namespace fathom::attribution
