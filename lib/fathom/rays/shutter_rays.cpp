#include "fathom/rays/shutter_rays.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "fathom/camera/image_points.h"
#include "fathom/failures/errors.h"
#include "fathom/lens/greatest_component.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/exact_words.h"
#include "fathom/numeric/ratio.h"
#include "fathom/numeric/real.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/ray_values.h"

namespace fathom {
namespace {

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

/// The rays of a row of a pinhole or an orthographic camera, from `to` on.
void write_straight_rays(const Camera& camera, std::uint32_t row, Ray* to) {
  const ImageRays image(camera, PointFrame::world);
  const Pose pose = camera_to_world(camera.world_to_camera);
  const auto column = [&](int k) { return std::array{pose[0][k], pose[1][k], pose[2][k]}; };
  for (std::uint32_t u = 0; u < camera.width; ++u) {
    const std::array<double, 3> varying = image.of_pixel(u, row);
    to[u] = is_perspective(camera.projection) ? Ray{column(3), varying} : Ray{varying, column(2)};
  }
}

/// Takes exact directions from a camera's frame to the world, and rounds them once. In the camera's
/// frame they have z = 1 if `is_plane`; otherwise their greatest component is 1 or −1.
class WorldDirections {
 public:
  WorldDirections(const Pose& world_to_camera, bool is_plane) : is_plane_(is_plane) {
    auto [rows, determinant, translation] = camera::adjugate(world_to_camera);
    const bool is_mirrored = determinant.sign() == Sign::negative;
    determinant_ = is_mirrored ? -determinant : determinant;
    determinant_words_ = in_words(determinant_);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        rows_[k][i] = is_mirrored ? -rows[k][i] : rows[k][i];
        row_words_[k][i] = in_words(rows_[k][i]);
      }
    }
  }

  [[nodiscard]] std::array<double, 3> of(const lens::ExactDirection& d) const {
    if (const auto words = d.words())
      if (const auto settled = in_double_words(*words)) return *settled;
    ExactVector3 denominator = is_plane_ ? lens::component(2) : lens::greatest_component(d);
    for (Dyadic& coefficient : denominator) coefficient *= determinant_;
    std::array<double, 3> direction;
    for (std::size_t k = 0; k < 3; ++k)
      direction[k] = round_to_binary64(
          triangle::quotient_at(d, LinearForm(rows_[k]), LinearForm(denominator)));
    return direction;
  }

 private:
  /// nullopt if the bounds do not settle which component is the greatest, or how one is rounded.
  [[nodiscard]] std::optional<std::array<double, 3>> in_double_words(
      const lens::DirectionWords& d) const {
    std::array<Words, 3> components, sizes;
    std::size_t scale = 2;
    for (std::size_t k = 0; k < 3; ++k) {
      components[k] = in_words<false>(d[k]);
      sizes[k] = d[k].value.hi < 0 ? -components[k] : components[k];
      if (!is_plane_ && sizes[k].value.hi > sizes[scale].value.hi) scale = k;
    }
    for (std::size_t k = 0; k < 3 && !is_plane_; ++k)
      if (k != scale && certain_sign(leading_word(sizes[scale] - sizes[k])) != Sign::positive)
        return std::nullopt;
    const Words denominator = sizes[scale] * determinant_words_;
    std::array<double, 3> direction;
    for (std::size_t k = 0; k < 3; ++k) {
      const Words x = (row_words_[k][0] * components[0] + row_words_[k][1] * components[1] +
                       row_words_[k][2] * components[2]) /
                      denominator;
      const std::optional<double> settled = to_binary64(x.value, x.error);
      if (!settled) return std::nullopt;
      direction[k] = *settled;
    }
    return direction;
  }

  bool is_plane_;
  /// The inverse of the pose's matrix is rows_ / determinant_, which is positive.
  std::array<ExactVector3, 3> rows_;
  Dyadic determinant_;
  std::array<std::array<Words, 3>, 3> row_words_;
  Words determinant_words_;
};

/// The rays of a row of a camera with a lens, from `to` on. Where a pixel has no ray, the direction
/// is 0.
void write_bent_rays(const Camera& camera, const lens::Preimages& preimages, std::uint32_t row,
                     Ray* to) {
  const Pose pose = camera_to_world(camera.world_to_camera);
  const WorldDirections directions(camera.world_to_camera, is_plane(preimages.lens().model));
  for (std::uint32_t u = 0; u < camera.width; ++u) {
    to[u] = Ray{{pose[0][3], pose[1][3], pose[2][3]}, {}};
    if (const auto d = preimages.of_pixel(u, row)) to[u].direction = directions.of(*d);
  }
}

}  // namespace

// Faults are found by one thread after the work of all, so that every number of threads reports the
// same one.
std::vector<Ray> shutter_rays(const Camera& camera, const Trajectory& path,
                              const RollingShutter& shutter, int threads) {
  const StandardArithmetic standard;
  require_valid(camera);
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
  if (bends_rays(camera.projection)) {
    const lens::Preimages preimages(camera.projection, *camera.projection.lens);
    for_each_row([&](std::uint32_t row) {
      write_bent_rays(cameras[row], preimages, row, &rays[row * width]);
    });
  } else {
    for_each_row(
        [&](std::uint32_t row) { write_straight_rays(cameras[row], row, &rays[row * width]); });
  }
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const bool has_ray = rays[k].direction != std::array<double, 3>{};
    if (has_ray && rays::is_finite(rays[k])) continue;
    const std::string pixel =
        "the pixel in column " + std::to_string(k % width) + ", row " + std::to_string(k / width);
    if (has_ray) throw InputError("camera: the ray of " + pixel + " is beyond binary64");
    throw InputError("camera: " + pixel +
                     " sees nothing by the lens; crop the image, or undistort it");
  }
  return rays;
}

}  // namespace fathom
