#include "validation/vtk/camera_matrix.h"

#include <cmath>

#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::validation {

using attribution::ClipRow;
using attribution::RasterModel;

bool is_matrix_of(const Camera& camera, const RasterModel& model,
                  const std::array<float, 16>& clip_from_held) {
  RasterModel factors = model;
  factors.premultiplied = false;  // magnitudes are then sums of absolute products
  const std::array<ClipRow, 4> rows = rows_of_camera(camera, factors);
  // Ours loses less than 2⁻⁴⁶ of the terms in binary64, and so does a renderer's, in fewer than 2⁷
  // roundings.
  const double lost = std::ldexp(1, -45);
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double scale = k < 3 ? model.scale[k] : 1;
      const double terms = rows[r].loss[k] + rows[r].magnitude[k];
      const double exact = rows[r].row[k] / scale;
      const double bound = unit_roundoff<float> * std::abs(exact) + lost * terms / std::abs(scale);
      if (!(std::abs(clip_from_held[4 * r + k] - exact) <= bound)) return false;
    }
  }
  return true;
}

}  // namespace fathom::validation
