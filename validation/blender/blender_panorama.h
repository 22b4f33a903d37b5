#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

/// The panoramic cameras of Cycles, and the rays that it shoots for them.
namespace fathom::validation {

/// In millimetres, of all cameras that Blender is given.
inline constexpr double blender_sensor_width = 36;

/// A panoramic camera in Blender's terms.
struct BlenderPanorama {
  enum class Type { equirectangular, mirror_ball, fisheye_equidistant, fisheye_equisolid };
  Type type = Type::equirectangular;
  /// Of a fisheye: the field of view in radians.
  double fov = 0;
  /// Of the equisolid fisheye: the focal length in millimetres, for a sensor 36 mm wide.
  double lens = 0;
};

/// "EQUIRECTANGULAR", as Blender calls it.
std::string name_of(BlenderPanorama::Type type);

/// The panorama that a camera is: EQUIRECTANGULAR of 360°×180°, FISHEYE with max_radius, and
/// FISHEYE_EQUISOLID with max_radius or, as a mirror ball, of the image's width and height. Its
/// axis is in the middle of the image. nullopt for other cameras.
std::optional<BlenderPanorama> panorama_of(const Camera& camera);

/// A camera of each type at the origin, named after it; near and far are distances that suit scenes
/// of about unit size.
std::vector<Camera> blender_panoramas(std::uint32_t width, std::uint32_t height);

/// How Cycles computes the azimuth φ of a fisheye's ray from a position (u, v) in the image, at
/// radius r from its middle.
enum class CyclesAzimuth {
  /// acosf(u/r), as in Blender 3.4. Near 0 and π one step of u/r is a step of φ up to 3.5·10⁻⁴
  /// radian.
  by_acos,
  /// A function without such steps, which errs by a few roundings.
  exact
};

/// The rays of Cycles (of Blender 3.4.1), with bounds on their errors.
/// Samples lie up to `sample_error` pixels off the centre. No ray where the camera has none.
/// Exact    computed in binary64; bounds count each rounding to binary32, and 4 ulp for a sine, a
///          cosine or an inverse of one.
/// Needs    a camera with panorama_of().
attribution::PixelRays cycles_rays(const Camera& camera, double sample_error,
                                   CyclesAzimuth azimuth = CyclesAzimuth::by_acos);

}  // namespace fathom::validation
