#pragma once

#include <cmath>
#include <limits>
#include <memory>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "fathom/camera/camera_making.h"
#include "validation/scenes/shapes.h"

/// Right maps of a sphere, made from its exact depths.
namespace fathom::test {

inline Camera sphere_camera(double near, double far) {
  Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3,
                            {.width = 160, .height = 120, .vertical_fov = 45});
  camera.near = near;
  camera.far = far;
  return camera;
}

inline std::shared_ptr<const attribution::Truth> sphere_seen_by(const Camera& camera) {
  return std::make_shared<attribution::Truth>(
      attribution::make_truth(bench::as_scene({bench::sphere(128)}, "sphere"), camera));
}

/// The exact depths, rounded to binary32.
inline attribution::OtherMap in_binary32(const attribution::Truth& truth) {
  attribution::OtherMap map{
      .width = truth.camera.width, .height = truth.camera.height, .depths = truth.depths};
  for (double& depth : map.depths) depth = double{static_cast<float>(depth)};
  map.values = map.depths;
  return map;
}

/// The exact depths, stored as window depths of so many bits between near and far, read in
/// binary32.
inline attribution::OtherMap in_codes(const attribution::Truth& truth, int bits, double near,
                                      double far) {
  const attribution::WindowDepth window =
      attribution::window_depth(truth.camera.projection.model, Mapping::opengl, near, far);
  const double greatest = std::exp2(bits) - 1;
  attribution::OtherMap map = in_binary32(truth);
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    if (!(truth.depths[i] < std::numeric_limits<double>::infinity())) continue;
    const double code = std::nearbyint(window.of_depth(truth.depths[i]) * greatest);
    map.depths[i] = double{static_cast<float>(window.to_depth(code / greatest))};
  }
  map.values = map.depths;
  return map;
}

}  // namespace fathom::test
