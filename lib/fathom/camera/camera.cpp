#include "fathom/camera/camera.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

namespace {

std::optional<std::string> find_fault_of_table(const Camera& camera) {
  const std::optional<Lens>& lens = camera.projection.lens;
  if (!lens || !lens->directions) return std::nullopt;
  const DirectionTable& table = *lens->directions;
  if (!table.is_read() && table.source().path.empty())
    return "the table of directions was an array and is in no file; make the camera from the array";
  if (!table.is_read())
    return "the table of directions is in the file '" + table.source().path +
           "', which has not been read; give the camera file that names it";
  if (table.width() == camera.width && table.height() == camera.height) return std::nullopt;
  return "the table of directions has " + std::to_string(table.width()) + "x" +
         std::to_string(table.height()) + " pixels, expected the size of the image, " +
         std::to_string(camera.width) + "x" + std::to_string(camera.height);
}

}  // namespace

std::optional<std::string> find_fault(const Camera& camera) {
  const StandardArithmetic standard;
  if (camera.width == 0) return "width is 0, expected at least 1";
  if (camera.height == 0) return "height is 0, expected at least 1";
  if (auto fault = find_fault(camera.projection)) return fault;
  if (auto fault = find_fault_of_table(camera)) return fault;
  for (const auto& row : camera.world_to_camera)
    for (const double entry : row)
      if (!std::isfinite(entry)) return "world_to_camera has an entry that is not a finite number";
  if (!std::isfinite(camera.near)) return "near is not a finite number";
  if (camera.near < 0) return "near is negative, expected 0 or more";
  // Written this way so that a NaN is refused too.
  if (!(camera.far > camera.near)) return "far is not greater than near";
  if (determinant_of_rotation(camera.world_to_camera).is_zero())
    return "world_to_camera is singular: the determinant of its first three columns is exactly 0";
  return std::nullopt;
}

void require_valid(const Camera& camera) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
}

void require_straight(const Camera& camera, std::string_view why) {
  if (!bends_rays(camera.projection)) return;
  throw UsageError("the lens " + std::string(name_of(camera.projection.lens->model)) + ": " +
                   std::string(why) +
                   " (for undistorted images, 'fathom camera import … --ignore-distortion' leaves "
                   "the lens out; see docs/lenses.md)");
}

bool has_clip_planes(const Camera& camera) {
  return std::isfinite(camera.far) && (camera.near > 0 || is_orthographic(camera.projection));
}

}  // namespace fathom
