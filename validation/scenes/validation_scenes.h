#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// The scenes on which other renderers are validated:
/// - sphere: 5 thousand triangles
/// - spot, teapot: real meshes
/// - dense: 200 thousand triangles, most of them smaller than a pixel
/// - slivers: a fan of 200 triangles, a few hundredths of a pixel wide at its hub, before a wall
/// - coplanar: overlapping sheets in one plane, some of them present twice
/// - sheets: pairs of sheets 10⁻⁴ of their distance apart, at distances 1 to 300
/// - grid: orthographic, every corner on a pixel centre
/// - vertices: every ray exactly through a corner
/// - room: a closed room seen from inside; floor and ceiling reach behind the camera
/// - utm: terrain whose coordinates have 6 and 7 digits before the decimal point
/// - range: far is 10⁷ times near
/// - orthographic: the teapot
/// - calibrated: a camera with skew, an off-centre principal point and pixels that are not square
/// - soup: 5 thousand overlapping triangles, about 20 over each pixel
namespace fathom::validation {

struct ValidationScene {
  std::string name;
  Scene scene;
  /// With finite near and far.
  Camera camera;
};

std::vector<std::string> scene_names();
bool is_scene_name(const std::string& name);

/// For an image of width × height pixels.
/// Fails    UsageError if there is no such scene.
ValidationScene make_validation_scene(const std::string& name, std::uint32_t width,
                                      std::uint32_t height);

/// The camera with near and far. If it has none, clip_range() chooses them just outside the scene
/// in front of it.
Camera with_clip_planes(const Scene& scene, Camera camera);

}  // namespace fathom::validation
