#include "fathom/attribution/raster/clip_vertex.h"

#include <cmath>

#include "fathom/attribution/model/own_roundings.h"
#include "fathom/attribution/raster/clip_rows.h"
#include "fathom/attribution/raster/vtk_shift.h"
#include "fathom/numeric/unit_roundoff.h"

// docs/validation.md, "A rasterizer", "Corners", derives what stands here.
namespace fathom::attribution {
namespace {

/// γₙ of the roundings on the way from a position to a clip coordinate: product and sums of each
/// matrix and one to spare; where they are not known, an entry and the position itself.
double gamma_of(const RasterModel& model) {
  const bool one_matrix = model.premultiplied || !model.parts.empty();
  const double roundings = model.matrix && model.parts.empty() ? 5 : one_matrix ? 7 : 13;
  const double n = roundings * unit_roundoff<float>;
  return n / (1 - n);
}

/// A position as the rows expect it; as the renderer holds it where its matrix is known.
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

}  // namespace fathom::attribution
