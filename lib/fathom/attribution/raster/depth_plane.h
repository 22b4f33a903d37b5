#pragma once

#include <limits>
#include <vector>

#include "fathom/attribution/raster/window_vertex.h"

namespace fathom::attribution {

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
