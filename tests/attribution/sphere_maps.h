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

/// The exact depths, stored as window depths of so many bits in the one way and read in binary32 in
/// the other.
inline attribution::OtherMap in_codes(const attribution::Truth& truth, int bits,
                                      const attribution::WindowDepth& stored,
                                      const attribution::WindowDepth& read) {
  const double greatest = std::exp2(bits) - 1;
  attribution::OtherMap map = in_binary32(truth);
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    if (!(truth.depths[i] < std::numeric_limits<double>::infinity())) continue;
    const double code = std::nearbyint(stored.of_depth(truth.depths[i]) * greatest);
    map.depths[i] = double{static_cast<float>(read.to_depth(code / greatest))};
  }
  map.values = map.depths;
  return map;
}

inline attribution::WindowDepth window_between(const attribution::Truth& truth, double near,
                                               double far) {
  return attribution::window_depth(truth.camera.projection.model, Mapping::opengl, near, far);
}

/// Stored between near and far, and decoded with them.
inline attribution::OtherMap in_codes(const attribution::Truth& truth, int bits, double near,
                                      double far) {
  const attribution::WindowDepth window = window_between(truth, near, far);
  return in_codes(truth, bits, window, window);
}

/// Stored between near and far, and decoded with the camera's.
inline attribution::OtherMap in_misread_codes(const attribution::Truth& truth, int bits,
                                              double near, double far) {
  return in_codes(truth, bits, window_between(truth, near, far),
                  window_between(truth, truth.camera.near, truth.camera.far));
}

}  // namespace fathom::test
