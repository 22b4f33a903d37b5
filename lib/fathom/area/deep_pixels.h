#pragma once

#include <functional>

#include "fathom/area/coverage.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/row_share.h"

/// The visible surfaces inside each pixel (specification, section 8), as files hold them.
namespace fathom::area {

/// All visible fragments of all pixels in a share of the rows; of the description, only the size is
/// filled in. Of the options, only culling and threads matter.
/// Exact    every value is the exact number rounded once.
DeepMap visible_in_pixels(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options, const RowShare& share = {},
                          const std::function<void(double)>& progress = {});

/// How much of each pixel of a share of the rows each matte covers, without names; `matte_of` gives
/// the id for the number of a triangle, and triangles of equal ids are one matte.
/// Exact    a coverage is the sum of the exact visible areas, rounded once.
Mattes mattes_in_pixels(const TriangleSource& triangles, const Camera& camera,
                        const RenderOptions& options,
                        const std::function<std::uint32_t(std::uint32_t)>& matte_of,
                        const RowShare& share = {},
                        const std::function<void(double)>& progress = {});

}  // namespace fathom::area
