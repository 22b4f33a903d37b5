#include "fathom/attribution/raster/clip_vertex.h"

#include <cmath>

#include "fathom/attribution/model/own_roundings.h"
#include "fathom/attribution/raster/clip_rows.h"
#include "fathom/numeric/unit_roundoff.h"

// docs/validation.md, "A rasterizer", "Corners", derives what stands here.
namespace fathom::attribution {
namespace {

/// γₙ of the roundings on the way from a position to a clip coordinate: product and sums of each
/// matrix and one to spare; where they are not known, an entry and the position itself.
double gamma_of(const RasterModel& model) {
  const double roundings = model.matrix ? 5 : model.premultiplied ? 7 : 13;
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

}  // namespace

std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RasterModel& model) {
  const std::array<ClipRow, 4> rows = clip_rows(camera, model);
  const double gamma = gamma_of(model);
  std::vector<ClipVertex> vertices(mesh.points.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::array<double, 3> position = held(mesh.points[i], model);
    for (std::size_t r = 0; r < 4; ++r) {
      double value = rows[r].row[3], magnitude = rows[r].magnitude[3];
      for (std::size_t k = 0; k < 3; ++k) {
        value += rows[r].row[k] * position[k];
        magnitude += rows[r].magnitude[k] * std::abs(position[k]);
      }
      vertices[i].value[r] = value;
      vertices[i].error[r] = own_roundings * gamma * magnitude + 0x1p-46 * rows[r].loss;
    }
    if (model.mapping == Mapping::opengl) {  // z is 2·z_window − w there
      vertices[i].value[2] = (vertices[i].value[2] + vertices[i].value[3]) / 2;
      vertices[i].error[2] /= 2;
    }
  }
  return vertices;
}

}  // namespace fathom::attribution
