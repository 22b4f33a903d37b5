#pragma once

#include <array>

#include "fathom/image/rgb_image.h"

/// Too few samples in space, and in time.
namespace fathom::studies {

/// A curve filled at 48 × 48 and enlarged eight times, and filled anew at 384 × 384.
std::array<RgbImage, 2> curve_twice();

/// A wheel of 12 spokes that turns by 27 degrees a frame, in eight frames side by side: as it is,
/// and as the mean of 16 instants for each frame.
RgbImage turning_wheel(bool temporal_supersampling);

}  // namespace fathom::studies
