#include "fathom/attribution/raster/matrix_roundings.h"

#include <cmath>

#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
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
