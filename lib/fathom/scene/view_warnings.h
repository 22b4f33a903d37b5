#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/scene.h"

/// Warnings about suspicious cameras: mistakes that give a map of the right size that is empty or
/// shows the wrong part of the scene. Warnings do not change the map, and a suspicious camera is
/// still valid.
///
/// Exact    nothing: all is judged in binary64, by the thresholds below.
namespace fathom {

/// Tolerance of the entries of RᵀR against the identity. float32 (10⁻⁶) and six printed decimals
/// (2·10⁻⁶) cause much smaller errors.
inline constexpr double rotation_tolerance = 1e-5;
/// The least number of turns of an object's surface around an eye that is inside: of a closed one
/// it is exactly 1.
inline constexpr double closed_winding = 0.95;
/// A map that shows no more pixels than these shows a speck.
inline constexpr std::uint64_t most_pixels_of_a_speck = 4;

struct ViewWarning {
  enum class Kind {
    mirrored,
    scaled,
    not_a_rotation,
    principal_point,
    without_ray,
    units,
    behind,
    outside,
    out_of_range,
    too_small,
    nothing_shown,
    inside_solid
  };
  Kind kind;
  /// One line, without the name of a file.
  std::string text;
};

/// Warnings about a camera by itself: a 3×3 part of world_to_camera that is scaled, mirrored
/// (unless fx or fy mirrors it back) or skewed; a principal point of a perspective camera outside
/// the middle half of the image, or in the middle of an image with exchanged width and height;
/// pixels without a ray, because the lens ends there.
/// Cost     negligible; of a lens about a millisecond, and of a table one look at each pixel.
/// Fails    never; a camera with a fault (find_fault) gets no warning.
std::vector<ViewWarning> warnings_of_camera(const Camera& camera);

/// Warnings about a camera that looks at a scene, given how many pixels of its map show the scene:
/// - none: the scene lies behind the camera, outside the image or the range of depth, or
///   between pixel centres; and which other reading of the matrix would show it, if one does;
/// - a speck: the scene is a thousand times too small (metres mixed with poses in millimetres);
/// - every pixel: the eye is inside a closed object whose triangles face outwards, or the object
///   is a thousand times too large (millimetres mixed with poses in metres).
/// `scene` may be the outline of a scene that stays in its files (outline_of).
/// Cost     none if a part of the image shows the scene and a part does not; of a map without
///          background, one look at every triangle; else some.
/// Fails    InputError if the scene or the camera has a fault (find_fault).
std::vector<ViewWarning> warnings_of_view(const Scene& scene, const Camera& camera,
                                          std::uint64_t shown_pixels);

/// Both kinds of warnings; if the camera's lens bends rays, only the warnings about the camera
/// itself.
std::vector<ViewWarning> view_warnings(const Scene& scene, const Camera& camera,
                                       std::uint64_t shown_pixels);

/// The warnings of the cameras of a path, each kind once: the first text, and for how many cameras
/// it holds.
Warnings told_once(std::span<const std::vector<ViewWarning>> of_cameras);

}  // namespace fathom
