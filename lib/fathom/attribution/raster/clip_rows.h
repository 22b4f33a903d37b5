#pragma once

#include <array>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// One row of the matrix from positions in the world to clip coordinates as OpenGL has them:
/// value = row·(p, 1), p a position less the model's shift and, where the matrix is known, scaled.
struct ClipRow {
  std::array<double, 4> row{};
  /// What the renderer's roundings are relative to: error <= γ·magnitude·(|p|, 1).
  std::array<double, 4> magnitude{};
  /// What was lost in making the row in binary64, here or there, is less than 2⁻⁴⁶ of loss·(|p|,
  /// 1).
  std::array<double, 4> loss{};
};

/// The rows of x, y (up), z and w: those of the model's matrix where it is known.
std::array<ClipRow, 4> clip_rows(const Camera& camera, const RasterModel& model);

/// The rows of a part: value = row·(p, 1), p a position in its frame less its shift.
std::array<ClipRow, 4> rows_of_part(const Camera& camera, const RasterModel& model,
                                    const RasterPart& part);

/// The rows that a camera has, whether or not the model's matrix is known; no scale.
std::array<ClipRow, 4> rows_of_camera(const Camera& camera, const RasterModel& model);

}  // namespace fathom::attribution
