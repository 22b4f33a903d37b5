#include "fathom/attribution/raster/clip_rows.h"

#include <Eigen/Core>
#include <cmath>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::attribution {
namespace {

/// Rows of x, y (up), z, w over the camera frame (x, y, depth, 1), as OpenGL has them.
Eigen::Matrix4d clip_from_camera(const Camera& camera, const WindowDepth& window) {
  const double w = camera.width, h = camera.height;
  const auto [cx, cy] = principal_point(camera);
  const double xx = 2 * camera.fx / w, xy = 2 * camera.skew / w, x1 = 2 * cx / w - 1;
  const double yy = -2 * camera.fy / h, y1 = 1 - 2 * cy / h;
  double a = window.a, b = window.b;
  if (window.minus_one_to_one) {  // 2z − w
    a = window.perspective ? 2 * a - 1 : 2 * a;
    b = window.perspective ? 2 * b : 2 * b - 1;
  }
  Eigen::Matrix4d m;
  if (window.perspective) {
    m << xx, xy, x1, 0,  //
        0, yy, y1, 0,    //
        0, 0, a, b,      //
        0, 0, 1, 0;
  } else {
    m << xx, xy, 0, x1,  //
        0, yy, 0, y1,    //
        0, 0, a, b,      //
        0, 0, 0, 1;
  }
  return m;
}

Eigen::Matrix4d camera_from_world(const Camera& camera) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topRows<3>() = geometry::as_matrix(camera.world_to_camera);
  return m;
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

/// Where positions stand before the view is applied: place·(position) with the shift put back, and
/// the sums of the magnitudes of its terms.
struct Place {
  Eigen::Matrix4d value = Eigen::Matrix4d::Identity(), terms = Eigen::Matrix4d::Identity();
};

Place place_of(const std::array<std::array<double, 4>, 3>& world_from_part,
               const std::array<double, 3>& shift) {
  Place place;
  const Eigen::Vector3d s = geometry::as_vector(shift);
  place.value.topRows<3>() = geometry::as_matrix(world_from_part);
  place.terms = place.value.cwiseAbs();
  place.terms.col(3).head<3>() += place.terms.topLeftCorner<3, 3>() * s.cwiseAbs();
  place.value.col(3).head<3>() += place.value.topLeftCorner<3, 3>() * s;
  return place;
}

std::array<ClipRow, 4> rows_from(const Camera& camera, Mapping mapping, const Place& place,
                                 bool premultiplied) {
  const WindowDepth window = window_depth(camera.projection, mapping, camera.near, camera.far);
  const Eigen::Matrix4d projection = clip_from_camera(camera, window);
  const Eigen::Matrix4d view = camera_from_world(camera);
  const Eigen::Matrix4d placed_view = view * place.value;
  const Eigen::Matrix4d product = projection * placed_view;
  const Eigen::Matrix4d magnitude = premultiplied
                                        ? product.cwiseAbs().eval()
                                        : (projection.cwiseAbs() * placed_view.cwiseAbs()).eval();
  const Eigen::Matrix4d loss = projection.cwiseAbs() * view.cwiseAbs() * place.terms;
  std::array<ClipRow, 4> rows;
  for (std::size_t r = 0; r < 4; ++r) {
    const auto i = static_cast<Eigen::Index>(r);
    Eigen::Map<Eigen::RowVector4d>(rows[r].row.data()) = product.row(i);
    Eigen::Map<Eigen::RowVector4d>(rows[r].magnitude.data()) = magnitude.row(i);
    Eigen::Map<Eigen::RowVector4d>(rows[r].loss.data()) = loss.row(i);
  }
  return rows;
}

}  // namespace

std::array<ClipRow, 4> rows_of_camera(const Camera& camera, const RasterModel& model) {
  const RasterPart as_it_is;
  const Place place = place_of(as_it_is.world_from_part, model.shift);
  return rows_from(camera, model.mapping, place, model.premultiplied);
}

std::array<ClipRow, 4> rows_of_part(const Camera& camera, const RasterModel& model,
                                    const RasterPart& part) {
  return rows_from(camera, model.mapping, place_of(part.world_from_part, part.shift), true);
}

std::array<ClipRow, 4> clip_rows(const Camera& camera, const RasterModel& model) {
  return model.matrix ? rows_of_matrix(*model.matrix) : rows_of_camera(camera, model);
}

}  // namespace fathom::attribution
