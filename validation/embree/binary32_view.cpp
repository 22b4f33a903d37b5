#include "validation/embree/binary32_view.h"

#include "fathom/attribution/model/renderer_camera.h"

namespace fathom::validation {
namespace {

using attribution::CameraRays;

Binary32View::Affine narrowed(const CameraRays::Affine& f) {
  const auto narrow = [](const std::array<double, 3>& v) {
    return std::array<float, 3>{static_cast<float>(v[0]), static_cast<float>(v[1]),
                                static_cast<float>(v[2])};
  };
  return {narrow(f.at_corner), narrow(f.per_u), narrow(f.per_v)};
}

}  // namespace

Binary32View binary32_view(const Camera& camera) {
  const CameraRays rays = attribution::camera_rays(camera);
  return {camera.width,
          camera.height,
          static_cast<float>(camera.near),
          static_cast<float>(camera.far),
          narrowed(rays.origin),
          narrowed(rays.direction)};
}

}  // namespace fathom::validation
