#include "fathom/attribution/model/clip_from_held.h"

#include "fathom/attribution/raster/clip_rows.h"

namespace fathom::attribution {

std::array<float, 16> clip_from_held(const Camera& camera, const RasterModel& model) {
  const std::array<ClipRow, 4> rows = rows_of_camera(camera, model);
  std::array<float, 16> matrix{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      matrix[4 * r + k] =
          static_cast<float>(k < 3 ? rows[r].row[k] / model.scale[k] : rows[r].row[3]);
    }
  }
  return matrix;
}

}  // namespace fathom::attribution
