#pragma once

#include <array>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

namespace fathom::validation {

/// Whether a matrix from held positions to clip coordinates, row by row, is the camera's: each
/// entry is what the camera and the model's shift and scale make it, computed in binary64 and
/// rounded once to binary32. A model takes the matrix that a renderer had for given, so this must
/// hold, or it would explain a picture that another camera sees.
///
/// Needs    near and far of the camera as the model's mapping does.
bool is_matrix_of(const Camera& camera, const attribution::RasterModel& model,
                  const std::array<float, 16>& clip_from_held);

}  // namespace fathom::validation
