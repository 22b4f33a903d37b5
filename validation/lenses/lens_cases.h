#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fathom/attribution/truth.h"
#include "fathom/camera/camera.h"
#include "fathom/rays/ray.h"
#include "fathom/scene/scene.h"
#include "validation/scenes/validation_scenes.h"

/// Scenes seen through lenses, as a ray tracer in binary32 can be given them.
namespace fathom::validation {

/// A camera at the origin that looks along z, for an image of width × height pixels, with a lens of
/// each of these models: OPENCV, OPENCV_FISHEYE, UCM, EUCM, DOUBLE_SPHERE, FISHEYE_EQUISOLID,
/// EQUIRECTANGULAR, CYLINDRICAL and TABLE. Its name is the model's.
std::vector<Camera> lens_cameras(std::uint32_t width, std::uint32_t height);

/// The names of lens_cameras().
std::vector<std::string> lens_names();

/// A scene and a camera with a lens.
///
/// Frame    the camera's, which is the world here.
struct LensCase {
  std::string scene;
  /// At the origin.
  Camera camera;
  /// One mesh; each coordinate is a binary32 number.
  Scene world;
  /// Depths are distances, rounded once to binary32.
  attribution::Truth truth;
};

/// The scene as `lens` sees it from the place of the scene's own camera. The triangles are moved
/// into the frame of the camera, and each coordinate is then rounded once to binary32.
/// Fails    InputError if the scene has no triangle.
LensCase lens_case(const ValidationScene& scene, const Camera& lens);

/// The scene for Blender, whose camera stands at the origin and looks along −z. Coordinates only
/// change their signs, so that Blender's matrix of the camera is the unit matrix.
ValidationScene scene_for_blender(const ValidationScene& scene, const Camera& panorama);

/// The rays of the pixels as an engine is given them: each direction is the exact one, scaled to a
/// greatest component of 1 or −1, with each component rounded once to binary32.
struct RoundedRays {
  /// One for each pixel that has a ray, row by row.
  std::vector<Ray> rays;
  /// The pixels of these rays.
  std::vector<std::size_t> pixels;
};
RoundedRays rounded_rays(const Camera& camera);

}  // namespace fathom::validation
