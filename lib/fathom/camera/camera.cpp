#include "fathom/camera/camera.h"

#include <cmath>
#include <utility>

#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// A coordinate of the principal point in the image of the specification, where the centre of the
/// top left pixel is at ½: c + (½ − pixel_centre).
Dyadic centred(double c, double pixel_centre) {
  return Dyadic(c) + (Dyadic(0.5) - pixel_centre);
}

std::optional<std::string> find_number_that_is_not_finite(const Camera& camera) {
  const std::pair<const char*, double> numbers[] = {
      {"fx", camera.fx},    {"fy", camera.fy},     {"cx", camera.cx},
      {"cy", camera.cy},    {"skew", camera.skew}, {"pixel_centre", camera.pixel_centre},
      {"near", camera.near}};
  for (const auto& [name, value] : numbers)
    if (!std::isfinite(value)) return std::string(name) + " is not a finite number";
  for (const auto& row : camera.world_to_camera)
    for (const double entry : row)
      if (!std::isfinite(entry)) return "world_to_camera has an entry that is not a finite number";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const Camera& camera) {
  const StandardArithmetic standard;
  if (camera.width == 0) return "width is 0, expected at least 1";
  if (camera.height == 0) return "height is 0, expected at least 1";
  if (auto fault = find_number_that_is_not_finite(camera)) return fault;
  if (camera.fx == 0) return "fx is 0, expected any other number";
  if (camera.fy == 0) return "fy is 0, expected any other number";
  if (camera.near < 0) return "near is negative, expected 0 or more";
  // Written this way so that a NaN is refused too.
  if (!(camera.far > camera.near)) return "far is not greater than near";
  if (determinant_of_rotation(camera).is_zero())
    return "world_to_camera is singular: the determinant of its first three columns is exactly 0";
  return std::nullopt;
}

void require_valid(const Camera& camera) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
}

Dyadic determinant_of_rotation(const Camera& camera) {
  const auto row = [&](int i) {
    const auto& r = camera.world_to_camera[i];
    return ExactVector3{r[0], r[1], r[2]};
  };
  return determinant(row(0), row(1), row(2));
}

std::array<std::array<double, 4>, 3> camera_to_world(const Camera& camera) {
  const StandardArithmetic standard;
  const auto pose = camera::inverse(camera.world_to_camera);
  if (!pose) throw InputError("the camera cannot be inverted: its matrix is singular");
  return *pose;
}

CameraPoint to_camera(const Camera& camera, const WorldPoint& X) {
  const auto row = [&](int i) {
    const auto& [r0, r1, r2, t] = camera.world_to_camera[i];
    return r0 * X.x + r1 * X.y + r2 * X.z + t;
  };
  return {row(0), row(1), row(2)};
}

HomogeneousImagePoint to_image(const Camera& camera, const CameraPoint& p) {
  const Dyadic W = camera.projection == Projection::perspective ? p.z : Dyadic(1.0);
  return {camera.fx * p.x + camera.skew * p.y + centred(camera.cx, camera.pixel_centre) * W,
          camera.fy * p.y + centred(camera.cy, camera.pixel_centre) * W, W};
}

PrincipalPoint principal_point(const Camera& camera) {
  const StandardArithmetic standard;
  const WordPair half_less_centre = two_sum(0.5, -camera.pixel_centre);
  // For 0 and ½ the difference is exact, and the sum is the only rounding.
  if (half_less_centre.lo == 0)
    return {camera.cx + half_less_centre.hi, camera.cy + half_less_centre.hi};
  const auto rounded = [&](double c) {
    return round_to_binary64(Ratio(centred(c, camera.pixel_centre)));
  };
  return {rounded(camera.cx), rounded(camera.cy)};
}

}  // namespace fathom
