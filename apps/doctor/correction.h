#pragma once

#include <vector>

#include "apps/doctor/data_set.h"
#include "apps/doctor/diagnosis.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

namespace fathom::doctor {

/// The camera of a view without the faults that were found.
Camera corrected_camera(const View& view, const Diagnosis& found);

/// The depth image of a view without the faults that were found: Z in scene units, binary32, +∞
/// where there is no value. Numbers at the ceiling of the data set become +∞ if they are clipped
/// depths or stand for no value.
DepthMap corrected_map(const DataSet& data, const View& view, const Diagnosis& found);

}  // namespace fathom::doctor
