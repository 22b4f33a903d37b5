#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fathom/camera/pose.h"
#include "fathom/lens/without_ray.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/view_warnings.h"

namespace fathom {
using namespace camera;

namespace {

using Kind = ViewWarning::Kind;

/// The largest magnitude in the 3×3 part.
double largest_entry(const Pose& pose) {
  double largest = 0;
  for (const auto& row : pose)
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(row[k]));
  return largest;
}

/// RᵀR of the 3×3 part, divided by `unit` first so that nothing overflows.
Matrix3 gram_matrix(const Pose& pose, double unit) {
  Matrix3 G{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) G[i][k] += pose[j][i] / unit * (pose[j][k] / unit);
  return G;
}

/// The largest entry of |G/square − I|.
double distance_from_identity(const Matrix3& G, double square) {
  double distance = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      distance = std::max(distance, std::abs(G[i][k] / square - (i == k ? 1 : 0)));
  return distance;
}

void add_warnings_of_rotation(const Camera& camera, std::vector<ViewWarning>& warnings) {
  if (!is_mirrored(camera.projection) &&
      determinant_of_rotation(camera.world_to_camera).sign() == Sign::negative) {
    warnings.push_back(
        {Kind::mirrored,
         "world_to_camera mirrors: the determinant of its 3×3 part is negative; negate one row, or "
         "check which axes it is meant for (x right, y down, z forward)"});
  }
  const double unit = largest_entry(camera.world_to_camera);
  const Matrix3 G = gram_matrix(camera.world_to_camera, unit);
  const double distance = distance_from_identity(G, 1 / unit / unit);
  if (distance <= rotation_tolerance) return;
  const double square = (G[0][0] + G[1][1] + G[2][2]) / 3;
  if (distance_from_identity(G, square) <= rotation_tolerance) {
    const bool perspective = is_perspective(camera.projection);
    warnings.push_back(
        {Kind::scaled,
         fmt::format("world_to_camera scales by {:.6g}: depths are so many times those of the "
                     "scene; divide its 12 numbers by it{}",
                     unit * std::sqrt(square),
                     perspective ? " for the same picture in scene units"
                                 : ", and multiply fx, fy and skew, for the same picture in scene "
                                   "units")});
  } else {
    warnings.push_back(
        {Kind::not_a_rotation,
         fmt::format("the 3×3 part R of world_to_camera is no rotation: an entry of RᵀR is {:.2g} "
                     "away from the identity's; check its numbers, or write them with more digits",
                     distance)});
  }
}

/// Whether x is no farther from the middle than a part of the size.
bool in_middle(double x, double size, double part) {
  return std::abs(x - size / 2) <= part * size;
}

bool has_principal_point(const Projection& projection) {
  return is_perspective(projection) && !(projection.lens && projection.lens->directions);
}

void add_warning_of_principal_point(const Camera& camera, std::vector<ViewWarning>& warnings) {
  if (!has_principal_point(camera.projection)) return;
  const auto [x, y] = principal_point(camera.projection);
  const auto lies_in_middle = [&, x = x, y = y](double part) {
    return in_middle(x, camera.width, part) && in_middle(y, camera.height, part);
  };
  const auto would_lie_there_if_swapped = [&, x = x, y = y](double part) {
    return in_middle(y, camera.width, part) && in_middle(x, camera.height, part);
  };
  // K of a landscape image and the size of a portrait one.
  const bool fits_the_other_way = would_lie_there_if_swapped(0.02) && !lies_in_middle(0.0625);
  if (lies_in_middle(0.25) && !fits_the_other_way) return;
  const bool are_fractions = camera.projection.cx > 0 && camera.projection.cx <= 1 &&
                             camera.projection.cy > 0 && camera.projection.cy <= 1;
  const bool are_swapped = would_lie_there_if_swapped(0.0625);
  warnings.push_back(
      {Kind::principal_point,
       fmt::format("the principal point ({:.6g}, {:.6g}) lies far from the middle of the {}x{} "
                   "image; {}",
                   x, y, camera.width, camera.height,
                   are_fractions ? "cx and cy look like fractions of the image, expected pixels"
                   : are_swapped
                       ? "cx and cy look swapped, or width and height"
                       : "check that cx and cy are meant for this width and height (right if the "
                         "image is cut out of a larger one)")});
}

/// The fault of these pixels, after "have no ray and show nothing: ".
std::string reason_of(const lens::WithoutRay& without_ray, const Lens& lens) {
  using Reason = lens::WithoutRay::Reason;
  switch (without_ray.reason) {
    case Reason::fold:
      return fmt::format("they lie where the lens {} folds back", name_of(lens.model));
    case Reason::end_of_model:
      return fmt::format("they lie beyond the end of the lens {}", name_of(lens.model));
    case Reason::max_radius:
      return fmt::format("they lie beyond max_radius {}", lens.max_radius);
    case Reason::table:
      return "the table has no direction for them";
  }
  throw std::logic_error("no such reason");
}

void add_warning_of_samples_without_ray(const Camera& camera, std::vector<ViewWarning>& warnings) {
  const auto found = lens::find_samples_without_ray(camera.projection, camera.width, camera.height);
  if (!found) return;
  const double percent = 100 * found->share;
  warnings.push_back(
      {Kind::without_ray,
       fmt::format("{} of the pixels have no ray and show nothing: {} (channel valid marks them)",
                   percent < 0.1 ? "less than 0.1 %" : fmt::format("{:.1f} %", percent),
                   reason_of(*found, *camera.projection.lens))});
}

}  // namespace

std::vector<ViewWarning> warnings_of_camera(const Camera& camera) {
  const StandardArithmetic standard;
  std::vector<ViewWarning> warnings;
  if (find_fault(camera)) return warnings;
  add_warnings_of_rotation(camera, warnings);
  add_warning_of_principal_point(camera, warnings);
  add_warning_of_samples_without_ray(camera, warnings);
  return warnings;
}

}  // namespace fathom
