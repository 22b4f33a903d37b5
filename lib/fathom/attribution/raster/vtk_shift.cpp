#include "fathom/attribution/raster/vtk_shift.h"

#include <cmath>
#include <optional>

namespace fathom::attribution {
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

}  // namespace fathom::attribution
