#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"

/// Cameras made from a description. The result is rounded to binary64, and the rounded numbers
/// *are* the camera: the rotation is orthonormal only up to that rounding.
namespace fathom {

/// Image size, angle of view and distortion. Square pixels, the principal point in the middle of
/// the image, pixel_centre ½, no skew.
struct LensChoice {
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  ProjectionModel model = ProjectionModel::perspective;
  /// Perspective: the degrees, in (0, 180), that the height spans; fx is ½·height / tan(½·angle).
  double vertical_fov = 40;
  /// Perspective: fx = fy in pixels; takes the place of vertical_fov.
  std::optional<double> focal;
  /// Orthographic: scene units that the image's height spans; look_at() and orbit() need it.
  std::optional<double> vertical_extent;
  /// Perspective: how the lens bends rays. The angle and the framing of scenes ignore the lens:
  /// they are computed for the pinhole. A panorama shows the full turn; EQUIRECTANGULAR, 180° from
  /// top to bottom.
  std::optional<Lens> distortion;
  /// The range of planar depth that counts, in scene units.
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
};

using Vector3 = std::array<double, 3>;

/// The camera at `eye` that looks at `target` with `up` upwards in the image.
///
/// Frame    eye, target and up: world, scene units.
/// Exact    R is the exact orthonormal frame with every entry rounded once; t = −R·eye is computed
///          exactly from the rounded R and rounded once.
/// Fails    UsageError if eye and target coincide, if `up` is zero or along the line of sight (both
///          tested exactly), if a number is not finite, or if the lens is not valid.
Camera look_at(const Vector3& eye, const Vector3& target, const Vector3& up,
               const LensChoice& lens = {});

/// The direction of an eye, seen from the point that it looks at; in degrees.
///
/// elevation  angle above the horizontal plane, −90 (from below) to 90 (from above).
/// azimuth    angle around the up direction, counter-clockwise as seen from above. At 0 the image's
///            right is +x without its part along `up`, or +y if `up` is along x: the eye is on the
///            +z side (y up), the −y side (z up) or the −z side (x up). At 90 it is on the side
///            that is right in the image at 0.
/// up         the direction of the world that points up, of any length but 0.
struct View {
  double azimuth = 35;
  double elevation = 25;
  Vector3 up{0, 1, 0};
};

/// The camera at `distance` (scene units) from the world point `centre` in the direction of `view`,
/// looking at `centre`. The eye may be straight above or below; the azimuth then turns the image.
///
/// Exact    if `up` is along an axis, each entry of R is a sine, a cosine or a product of two of
///          them, rounded once. Otherwise the frame of `up` is rounded as in look_at(), and R, the
///          product of the rounded matrices, is rounded again.
///          t = (0, 0, distance) − R·centre is computed exactly from the rounded R and rounded
///          once.
/// Fails    UsageError if distance ≤ 0, elevation is outside [−90, 90], `up` is zero, a number is
///          not finite, or the lens is not valid.
Camera look_from(const View& view, const Vector3& centre, double distance,
                 const LensChoice& lens = {});

/// A camera path of `count` views around `centre`, the first at `first`, the others at azimuths
/// 360°/count apart, each azimuth rounded once.
/// progress, if given, is called after each camera with the fraction done; an exception ends the
/// call.
/// Fails    UsageError as look_from(), and if count is 0 or above 1,000,000.
std::vector<Camera> orbit(const View& first, std::uint32_t count, const Vector3& centre,
                          double distance, const LensChoice& lens = {},
                          const std::function<void(double)>& progress = {});

}  // namespace fathom
