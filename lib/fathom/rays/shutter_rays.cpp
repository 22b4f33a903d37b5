#include "fathom/rays/shutter_rays.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fathom/camera/image_points.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/ratio.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

constexpr std::string_view has_no_lens =
    "a rolling shutter is computed for pinholes only; leave the lens out of the camera, or "
    "undistort the images";

Placement placement_at(const Trajectory& path, const RollingShutter& shutter, std::uint32_t row,
                       std::uint32_t height) {
  const Ratio start{Dyadic(shutter.start)};
  if (height == 1) return path.at(start);
  const Dyadic rows(static_cast<double>(row)), last(static_cast<double>(height - 1));
  return path.at(start + Ratio(Dyadic(shutter.readout) * rows, last));
}

/// Where the camera stands while it measures a row.
Pose pose_of_row(const Camera& camera, const Trajectory& path, const RollingShutter& shutter,
                 std::uint32_t row) {
  const auto [position, quaternion] = placement_at(path, shutter, row, camera.height);
  const ExactVector3 eye{position[0], position[1], position[2]};
  return camera::rounded_pose(camera::composed(camera::exact_pose(camera.world_to_camera),
                                               camera::exact_view_from(eye, quaternion)));
}

/// The rays of a row of a camera, from `to` on.
void write_rays(const Camera& camera, std::uint32_t row, Ray* to) {
  const ImageRays image(camera, PointFrame::world);
  const Pose pose = camera_to_world(camera.world_to_camera);
  const auto column = [&](int k) { return std::array{pose[0][k], pose[1][k], pose[2][k]}; };
  for (std::uint32_t u = 0; u < camera.width; ++u) {
    const std::array<double, 3> varying = image.of_pixel(u, row);
    to[u] = is_perspective(camera.projection) ? Ray{column(3), varying} : Ray{varying, column(2)};
  }
}

}  // namespace

// Faults are found by one thread after the work of all, so that every number of threads reports the
// same one.
std::vector<Ray> shutter_rays(const Camera& camera, const Trajectory& path,
                              const RollingShutter& shutter, int threads) {
  const StandardArithmetic standard;
  require_valid(camera);
  require_straight(camera, has_no_lens);
  if (!std::isfinite(shutter.start) || !std::isfinite(shutter.readout))
    throw UsageError("the times of a rolling shutter: expected finite numbers");
  for (const std::uint32_t row : {0u, camera.height - 1})
    placement_at(path, shutter, row, camera.height);
  const auto for_each_row = [&](const auto& work) {
    with_threads(threads, [&] { parallel_for(std::uint32_t{0}, camera.height, work); });
  };
  std::vector<Camera> cameras(camera.height, camera);
  for_each_row([&](std::uint32_t row) {
    cameras[row].world_to_camera = pose_of_row(camera, path, shutter, row);
  });
  for (std::uint32_t row = 0; row < camera.height; ++row)
    if (const auto fault = find_fault(cameras[row]))
      throw InputError("camera: row " + std::to_string(row) + ": " + *fault);
  const std::size_t width = camera.width;
  std::vector<Ray> rays(width * camera.height);
  for_each_row([&](std::uint32_t row) { write_rays(cameras[row], row, &rays[row * width]); });
  for (std::size_t k = 0; k < rays.size(); ++k)
    if (!rays::is_finite(rays[k]))
      throw InputError("camera: the ray of the pixel in column " + std::to_string(k % width) +
                       ", row " + std::to_string(k / width) + " is beyond binary64");
  return rays;
}

}  // namespace fathom
