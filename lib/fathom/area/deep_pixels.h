#pragma once

#include <functional>

#include "fathom/area/coverage.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/deep_map.h"

/// The visible surfaces inside each pixel (specification, section 8), as files hold them.
namespace fathom::area {

/// All visible fragments of all pixels; of the description, the size alone is filled in. Of the
/// options culling, threads and progress count.
/// Exact    every value is the exact number rounded once.
DeepMap visible_in_pixels(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options);

/// How much of each pixel each matte covers, names left out; `matte_of` is asked for the id of the
/// number of a triangle, and triangles of equal ids are one matte.
/// Exact    a coverage is the sum of the exact visible areas, rounded once.
Mattes mattes_in_pixels(const TriangleSource& triangles, const Camera& camera,
                        const RenderOptions& options,
                        const std::function<std::uint32_t(std::uint32_t)>& matte_of);

}  // namespace fathom::area
