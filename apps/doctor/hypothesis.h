#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"

/// Hypotheses about the conventions of a data set: what its cameras and depth images mean.
namespace fathom::doctor {

/// The axes that a matrix has in place of x right, y down, z forward.
enum class CameraAxes : std::uint8_t { as_given, opengl, body };

/// The frame of the cameras, by the axes of the mesh that are its x, y and z.
enum class WorldAxes : std::uint8_t {
  as_given,
  x_minus_z_y,  ///< the mesh has y up, the cameras z
  x_z_minus_y,  ///< the mesh has z up, the cameras y
  x_minus_y_minus_z,
  y_z_x,
  z_x_y
};

/// What the matrix of a camera is: world to camera, or camera to world with the other axes applied
/// in the world's place or in the camera's; or it was converted from OpenGL's axes as the inverse.
enum class Matrix : std::uint8_t { as_given, inverse, inverse_of_turned, inverse_of_opengl };

/// How the pixels of an image lie in it.
enum class Turn : std::uint8_t { as_given, mirrored_x, mirrored_y, half, left, right };

/// What became of an image whose size is not its camera's.
enum class Resizing : std::uint8_t { as_given, scaled, cropped };

/// What the numbers of a lens mean.
enum class LensMeaning : std::uint8_t {
  as_given,
  ignored,
  opencv_as_fisheye,
  fisheye_as_opencv,
  tangential_swapped,
  radial_third,
  radial_before_tangential
};

/// Each member that has not its first value is a fault.
struct Hypothesis {
  CameraAxes camera_axes = CameraAxes::as_given;
  WorldAxes world_axes = WorldAxes::as_given;
  Matrix matrix = Matrix::as_given;
  /// Scene units per unit of the cameras' positions.
  double unit = 1;
  LensMeaning lens = LensMeaning::as_given;
  Resizing resizing = Resizing::as_given;
  Turn turn = Turn::as_given;
  /// Depths are distances along the ray.
  bool is_distance = false;
  /// Depths that stand for one scene unit.
  double depth_scale = 1;
  /// Pixels to add to cx and cy.
  double shift_x = 0, shift_y = 0;
  /// Codes were rounded towards zero.
  bool is_truncated = false;

  friend bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

/// The hypothesis without its faults of how stored depths are read: all with the same rest have the
/// same exact depths.
Hypothesis rendering_of(Hypothesis hypothesis);

/// The names of faults, as reports show them.
enum class Fault : std::uint8_t {
  image_size,
  matrix,
  camera_axes,
  world_axes,
  unit,
  mirrored,
  lens,
  ray_distance,
  depth_scale,
  half_pixel,
  truncated
};
std::string name_of(Fault fault);

/// The faults of a hypothesis, the coarsest first. Cameras and depths in another unit than the mesh
/// are one fault.
std::vector<Fault> faults_of(const Hypothesis& hypothesis);
/// The hypothesis with this fault left out.
Hypothesis without(Hypothesis hypothesis, Fault fault);
/// The fault as a clause.
std::string text_of(Fault fault, const Hypothesis& hypothesis);

/// The other meanings that the numbers of a lens may have.
std::vector<LensMeaning> other_meanings(const std::optional<Lens>& lens);

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

/// The camera of an image of this size, if the hypothesis holds.
Camera corrected(const Camera& given, const Hypothesis& hypothesis, const ImageSize& image);

/// Where the image has the pixel (x, y) of its camera; may lie outside the image.
std::array<std::int64_t, 2> stored_place(const Hypothesis& hypothesis, const Camera& camera,
                                         std::uint32_t x, std::uint32_t y);

}  // namespace fathom::doctor
