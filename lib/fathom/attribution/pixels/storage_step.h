#pragma once

#include "fathom/attribution/model/renderer_model.h"

namespace fathom::attribution {

/// The distance of neighbouring binary32 numbers about x.
double binary32_spacing(double x);

/// A step of the model's storage at a window depth, as a window depth: one code, but not less than
/// binary32 resolves there, nor than a shader's log2 may err.
double storage_step(const RasterModel& model, double window);

}  // namespace fathom::attribution
