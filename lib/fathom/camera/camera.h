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
///
/// Frame    world to camera: x right, y down, z forward; image: u right, v down.
/// Unit     lengths in scene units; cx and cy in pixels; fx, fy and skew in pixels (perspective) or
///          pixels per scene unit (orthographic).
struct Camera {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Projection projection = Projection::perspective;
  double fx = 1, fy = 1, cx = 0, cy = 0, skew = 0;
  /// The image coordinate of the top left pixel's centre, as cx and cy count: ½ (COLMAP, OpenGL) or
  /// 0 (OpenCV).
  double pixel_centre = 0.5;
  /// [R | t], 3×4; R need not be a rotation.
  std::array<std::array<double, 4>, 3> world_to_camera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  /// The range of planar depth that counts.
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  /// Name of its image in UTF-8; may be empty. Does not affect the map.
  std::string name;
};

/// The fault of a camera, in one line, or nothing if width and height are at least 1, all numbers
/// are finite (far may be +∞), det R ≠ 0 exactly, fx and fy ≠ 0, near ≥ 0 and far > near.
std::optional<std::string> find_fault(const Camera& camera);

/// Refuses a camera that is not valid.
/// Fails    InputError: "camera: " and the fault from find_fault().
void require_valid(const Camera& camera);

/// det R, exactly.
Dyadic determinant_of_rotation(const Camera& camera);

/// Camera to world, [R⁻¹ | −R⁻¹·t]: each entry is the exact one, rounded to nearest once.
/// Fails    InputError where R is singular.
std::array<std::array<double, 4>, 3> camera_to_world(const Camera& camera);

/// R·X + t, exactly; scene units.
CameraPoint to_camera(const Camera& camera, const WorldPoint& X);

/// The homogeneous image point of a camera point in pixels, exactly; accounts for `pixel_centre`.
HomogeneousImagePoint to_image(const Camera& camera, const CameraPoint& p);

/// The image of a camera's z axis: pixels from the top left corner of the image, y downwards.
struct PrincipalPoint {
  double x = 0, y = 0;
};

/// The principal point; accounts for `pixel_centre`.
/// Exact    each number is the exact one rounded once. Exact computations use to_image() instead.
PrincipalPoint principal_point(const Camera& camera);

}  // namespace fathom
