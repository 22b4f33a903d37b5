#pragma once

#include <array>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// The matrix from held positions, (position − shift)·scale, to clip coordinates as OpenGL has
/// them, row by row. Whatever matrix the model already has is not looked at.
///
/// Needs    near and far of the camera as the model's mapping does.
/// Exact    made in binary64, each entry then rounded to binary32.
std::array<float, 16> clip_from_held(const Camera& camera, const RasterModel& model);

}  // namespace fathom::attribution
