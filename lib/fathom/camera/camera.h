#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "fathom/geometry/frames.h"

namespace fathom {

enum class Projection { perspective, orthographic };

/// A camera as the specification (section 2) defines it. Every number is the real number that it
/// denotes. Valid if find_fault() finds nothing.
struct Camera {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Projection projection = Projection::perspective;
  double fx = 1, fy = 1, cx = 0, cy = 0, skew = 0;
  /// Image coordinate that (cx, cy) give to the centre of the top left pixel: ½ (COLMAP, OpenGL)
  /// or 0 (OpenCV).
  double pixel_centre = 0.5;
  /// [R | t], 3×4; R need not be a rotation.
  std::array<std::array<double, 4>, 3> world_to_camera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
};

/// What is wrong with a camera, in one line, or nothing: width and height at least 1, all numbers
/// finite (far may be +∞), det R ≠ 0 exactly, fx and fy ≠ 0, near ≥ 0, far > near.
std::optional<std::string> find_fault(const Camera& camera);

/// det R, exactly.
Dyadic determinant_of_rotation(const Camera& camera);

/// R·X + t, exactly.
CameraPoint to_camera(const Camera& camera, const WorldPoint& X);

/// The homogeneous image point of a camera point, exactly; `pixel_centre` is accounted for.
HomogeneousImagePoint to_image(const Camera& camera, const CameraPoint& p);

}  // namespace fathom
