#include "fathom/attribution/raster/clip_rows.h"

#include <cmath>

#include "fathom/attribution/model/window_depth.h"

namespace fathom::attribution {
namespace {

using Row = std::array<double, 4>;
using Matrix = std::array<Row, 4>;

/// Rows of x, y (up), z, w over the camera frame (x, y, depth, 1), as OpenGL has them.
Matrix clip_from_camera(const Camera& camera, const WindowDepth& window) {
  const double w = camera.width, h = camera.height;
  const auto [cx, cy] = principal_point(camera);
  const double xx = 2 * camera.fx / w, xy = 2 * camera.skew / w, x1 = 2 * cx / w - 1;
  const double yy = -2 * camera.fy / h, y1 = 1 - 2 * cy / h;
  double a = window.a, b = window.b;
  if (window.minus_one_to_one) {  // 2z − w
    a = window.perspective ? 2 * a - 1 : 2 * a;
    b = window.perspective ? 2 * b : 2 * b - 1;
  }
  if (window.perspective) {
    return {{{xx, xy, x1, 0}, {0, yy, y1, 0}, {0, 0, a, b}, {0, 0, 1, 0}}};
  }
  return {{{xx, xy, 0, x1}, {0, yy, 0, y1}, {0, 0, a, b}, {0, 0, 0, 1}}};
}

Matrix camera_from_world(const Camera& camera) {
  const auto& m = camera.world_to_camera;
  return {m[0], m[1], m[2], {0, 0, 0, 1}};
}

/// One row of the product of both matrices, for positions less the shift.
ClipRow product_row(const Row& projection, const Matrix& view, const RasterModel& model) {
  ClipRow made;
  for (std::size_t j = 0; j < 4; ++j) {
    Row eye = view[j];
    for (std::size_t k = 0; k < 3; ++k) {
      made.loss += std::abs(projection[j] * eye[k] * model.shift[k]);
      eye[3] += eye[k] * model.shift[k];
    }
    made.loss += std::abs(projection[j] * view[j][3]);
    for (std::size_t k = 0; k < 4; ++k) {
      made.row[k] += projection[j] * eye[k];
      made.magnitude[k] += std::abs(projection[j] * eye[k]);
    }
  }
  if (model.premultiplied) {
    for (std::size_t k = 0; k < 4; ++k) made.magnitude[k] = std::abs(made.row[k]);
  }
  return made;
}

std::array<ClipRow, 4> rows_of_matrix(const std::array<float, 16>& matrix) {
  std::array<ClipRow, 4> rows;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      rows[r].row[k] = matrix[4 * r + k];
      rows[r].magnitude[k] = std::abs(rows[r].row[k]);
    }
  }
  return rows;
}

}  // namespace

std::array<ClipRow, 4> rows_of_camera(const Camera& camera, const RasterModel& model) {
  const WindowDepth window =
      window_depth(camera.projection, model.mapping, camera.near, camera.far);
  const Matrix projection = clip_from_camera(camera, window), view = camera_from_world(camera);
  std::array<ClipRow, 4> rows;
  for (std::size_t r = 0; r < 4; ++r) rows[r] = product_row(projection[r], view, model);
  return rows;
}

std::array<ClipRow, 4> clip_rows(const Camera& camera, const RasterModel& model) {
  return model.matrix ? rows_of_matrix(*model.matrix) : rows_of_camera(camera, model);
}

}  // namespace fathom::attribution
