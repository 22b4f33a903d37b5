#include "fathom/attribution/raster/clip_vertex.h"

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/projection.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/numeric/standard_arithmetic.h"

// docs/validation.md, "A rasterizer", "Corners", derives the bounds in this file.
namespace fathom::attribution {
namespace {

/// Rows of x, y (up), z, w over the camera frame (x, y, depth, 1), as OpenGL has them.
Eigen::Matrix4d clip_from_camera(const Camera& camera, const WindowDepth& window) {
  const auto [xx, xy, x1, yy, y1] =
      RoundedProjection(camera.projection).clip_rows(camera.width, camera.height);
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

Eigen::Matrix4d homogeneous(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topRows<3>() = geometry::as_matrix(pose);
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

Place place_of(const Pose& world_from_part, const std::array<double, 3>& shift) {
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
  const WindowDepth window =
      window_depth(camera.projection.model, mapping, camera.near, camera.far);
  const Eigen::Matrix4d projection = clip_from_camera(camera, window);
  const Eigen::Matrix4d view = homogeneous(camera.world_to_camera);
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

namespace {

/// Written as there, so that a mesh at the limit falls on the same side.
bool is_far_or_large(double diagonal_squared, double distance_squared) {
  if (diagonal_squared == 0) return distance_squared > 1e6;
  return distance_squared / diagonal_squared > 1e6 || std::abs(std::log10(diagonal_squared)) > 3;
}

}  // namespace

RasterModel with_known_shift(const RasterModel& model, const WorldMesh& mesh) {
  RasterModel known = model;
  if (!model.shift_as_vtk || model.matrix) return known;
  known.shift_as_vtk = false;
  known.shift = {0, 0, 0};
  const std::optional<WorldBounds> box = box_of(mesh);
  if (!box) return known;
  std::array<double, 3> middle{};
  double diagonal_squared = 0, distance_squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = box->upper[k] - box->lower[k];
    middle[k] = 0.5 * (box->upper[k] + box->lower[k]);
    diagonal_squared += extent * extent;
    distance_squared += middle[k] * middle[k];
  }
  if (is_far_or_large(diagonal_squared, distance_squared)) known.shift = middle;
  return known;
}

namespace {

/// γₙ of the roundings from a position to a clip coordinate: the product and the sums of each
/// matrix and one spare rounding; if they are unknown, also an entry and the position itself.
double gamma_of(const RasterModel& model) {
  const bool one_matrix = model.premultiplied || !model.parts.empty();
  const double roundings = model.matrix && model.parts.empty() ? 5 : one_matrix ? 7 : 13;
  const double n = roundings * unit_roundoff<float>;
  return n / (1 - n);
}

/// A position as the rows expect it; if the renderer's matrix is known, as the renderer holds it.
std::array<double, 3> held(const std::array<double, 3>& point, const RasterModel& model) {
  std::array<double, 3> position{};
  for (std::size_t k = 0; k < 3; ++k) {
    position[k] = point[k] - model.shift[k];
    if (model.matrix) position[k] = static_cast<float>(position[k] * model.scale[k]);
  }
  return position;
}

ClipVertex clip_vertex(const std::array<ClipRow, 4>& rows, const std::array<double, 3>& position,
                       double gamma) {
  ClipVertex vertex;
  for (std::size_t r = 0; r < 4; ++r) {
    const ClipRow& row = rows[r];
    double value = row.row[3], magnitude = row.magnitude[3], loss = row.loss[3];
    for (std::size_t k = 0; k < 3; ++k) {
      value += row.row[k] * position[k];
      magnitude += row.magnitude[k] * std::abs(position[k]);
      loss += row.loss[k] * std::abs(position[k]);
    }
    vertex.value[r] = value;
    vertex.error[r] = own_roundings * gamma * magnitude + 0x1p-46 * loss;
  }
  return vertex;
}

std::vector<ClipVertex> vertices_of_mesh(const WorldMesh& mesh, const Camera& camera,
                                         const RasterModel& model) {
  const std::array<ClipRow, 4> rows = clip_rows(camera, model);
  const double gamma = gamma_of(model);
  std::vector<ClipVertex> vertices;
  vertices.reserve(mesh.points.size());
  for (const auto& point : mesh.points) {
    vertices.push_back(clip_vertex(rows, held(point, model), gamma));
  }
  return vertices;
}

std::vector<ClipVertex> vertices_of_parts(const Camera& camera, const RasterModel& model) {
  const double gamma = gamma_of(model);
  std::vector<ClipVertex> vertices;
  for (const RasterPart& part : model.parts) {
    const std::array<ClipRow, 4> rows = rows_of_part(camera, model, part);
    for (const auto& [x, y, z] : *part.points) {
      const auto& [sx, sy, sz] = part.shift;
      vertices.push_back(clip_vertex(rows, {x - sx, y - sy, z - sz}, gamma));
    }
  }
  return vertices;
}

}  // namespace

std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RasterModel& model) {
  std::vector<ClipVertex> vertices =
      model.parts.empty() ? vertices_of_mesh(mesh, camera, with_known_shift(model, mesh))
                          : vertices_of_parts(camera, model);
  if (model.mapping != Mapping::opengl) return vertices;
  for (ClipVertex& vertex : vertices) {  // z is 2·z_window − w there
    vertex.value[2] = (vertex.value[2] + vertex.value[3]) / 2;
    vertex.error[2] /= 2;
  }
  return vertices;
}

namespace {

/// The sum of a row's terms at a point, with the row's entries or with their magnitudes.
double at(const std::array<double, 4>& row, const std::array<double, 3>& point) {
  return row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3];
}

double of_magnitudes(const ClipRow& row, const std::array<double, 3>& point) {
  return at(row.magnitude, {std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
}

double value(const CameraRays::Affine& f, std::size_t k, double x, double y) {
  return f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k];
}

}  // namespace

MatrixRoundings::MatrixRoundings(const Camera& camera, const RasterModel& model,
                                 const WorldMesh& mesh)
    : rays_(camera_rays(camera)),
      shift_(with_known_shift(model, mesh).shift),
      width_(camera.width),
      of_entry_((model.premultiplied ? 1 : 2) * unit_roundoff<float>),
      half_(model.mapping == Mapping::opengl ? 0.5 : 1) {
  if (!model.matrix) rows_ = rows_of_camera(camera, with_known_shift(model, mesh));
}

double MatrixRoundings::of_window(std::size_t pixel, double depth) const {
  if (!rows_) return 0;
  const std::size_t column = pixel % width_, row = pixel / width_;
  const double x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = value(rays_.origin, k, x, y) + depth * value(rays_.direction, k, x, y) - shift_[k];
  }
  const ClipRow &z = (*rows_)[2], &w = (*rows_)[3];
  const double clip_w = at(w.row, point), ndc = at(z.row, point) / clip_w;
  const double moved = of_magnitudes(z, point) + std::abs(ndc) * of_magnitudes(w, point);
  return half_ * of_entry_ * moved / std::abs(clip_w);
}

}  // namespace fathom::attribution
