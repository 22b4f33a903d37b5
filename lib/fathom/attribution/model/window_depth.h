#pragma once

#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"

namespace fathom::attribution {

/// How a depth D becomes a window depth z: perspective z = a + b/D, orthographic z = a·D + b,
/// logarithmic z = ln(D/near)/ln(far/near).
///
/// Units    depths in scene units; window depths without a unit, 0 to 1 between near and far.
/// Exact    rounded to binary64 several times.
struct WindowDepth {
  bool perspective = true;
  /// Whether the renderer passes through z_ndc = 2z − 1 (OpenGL's default).
  bool minus_one_to_one = true;
  double a = 0, b = 0;
  /// Of a logarithmic one; ln(far/near) is 0 for the others.
  double near = 0, log_range = 0;

  [[nodiscard]] double of_depth(double depth) const;
  /// Infinite where no finite depth has this window depth or one beyond it.
  [[nodiscard]] double to_depth(double window) const;
  /// Whether nearer surfaces have greater window depths.
  [[nodiscard]] bool reversed() const { return log_range == 0 && (perspective ? b > 0 : a < 0); }
};

/// `mapping` is standard, opengl, log_ulrich or one of the reversed and infinite ones; `near` and
/// `far` are depths.
WindowDepth window_depth(Projection projection, Mapping mapping, double near, double far);

}  // namespace fathom::attribution
