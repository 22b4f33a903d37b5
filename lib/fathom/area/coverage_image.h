#pragma once

#include <functional>

#include "fathom/area/coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/triangle_bands.h"
#include "fathom/image/row_share.h"

namespace fathom::area {

/// What is called for a pixel, with the triangles that may cover a part of it, in the order of
/// their numbers; there is at least one.
using VisitPixel = std::function<void(std::uint32_t column, std::uint32_t row,
                                      std::span<const SurfaceRegion* const> triangles)>;

/// Visits every pixel of a share of the rows of which a triangle may cover a part, different ones
/// at the same time. `part_done`, if set, is called after each band of the share, from any thread.
void for_each_pixel(const CoverageFrame& frame, const VisitPixel& visit,
                    const std::function<void()>& part_done = {}, const RowShare& share = {});

/// Channel A of the whole image: width × height values, row by row from the top left, 0 where
/// nothing is covered. Every pixel is computed by itself. `part_done` as above. Returns how
/// decisions were made.
TierCounts write_coverage(const CoverageFrame& frame, float* values,
                          const std::function<void()>& part_done = {});

}  // namespace fathom::area
