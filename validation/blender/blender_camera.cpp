#include "validation/blender/blender_camera.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/errors.h"

namespace fathom::validation {
namespace {

constexpr double sensor_width = 36;

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("blender: cannot express " + what);
}

void require_rotation(const Camera& camera) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        product += camera.world_to_camera[i][k] * camera.world_to_camera[j][k];
      }
      if (std::abs(product - (i == j ? 1 : 0)) > 1e-6) refuse("a camera whose R is no rotation");
    }
  }
}

}  // namespace

BlenderCamera blender_camera(const Camera& camera) {
  if (camera.skew != 0) refuse("a camera with skew");
  if (camera.fx <= 0 || camera.fy <= 0) refuse("a mirrored camera");
  require_rotation(camera);
  const double pixel = camera.fx / camera.fy;  // aspect_y / aspect_x
  if (pixel > 2 || pixel < 0.5) refuse("pixels more than twice as wide as high, or the reverse");
  const double width = camera.width, height = camera.height;
  const auto [cx, cy] = principal_point(camera);

  BlenderCamera made;
  made.perspective = camera.projection == Projection::perspective;
  made.aspect_x = std::max(1.0, 1 / pixel);
  made.aspect_y = std::max(1.0, pixel);
  made.lens = camera.fx * sensor_width / width;
  made.ortho_scale = width / camera.fx;
  made.shift_x = (width / 2 - cx) / width;
  made.shift_y = (cy - height / 2) * pixel / width;

  const auto& m = camera.world_to_camera;
  for (std::size_t row = 0; row < 3; ++row) {
    double position = 0;
    for (std::size_t k = 0; k < 3; ++k) position -= m[k][row] * m[k][3];  // −Rᵀ·t
    made.world_from_camera[4 * row] = m[0][row];
    made.world_from_camera[4 * row + 1] = -m[1][row];
    made.world_from_camera[4 * row + 2] = -m[2][row];
    made.world_from_camera[4 * row + 3] = position;
  }
  made.world_from_camera[15] = 1;
  return made;
}

}  // namespace fathom::validation
