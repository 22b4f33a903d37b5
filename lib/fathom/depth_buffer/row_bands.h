#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/exact/projected_triangle.h"
#include "fathom/exact/triangle_source.h"

namespace fathom {

/// A triangle that may cover samples of its box.
struct BoxedTriangle {
  std::uint32_t number;
  PixelBox box;
};

/// Consecutive rows of an image, the work of one thread.
struct RowBand {
  std::uint32_t first_row = 0, end_row = 0;
  /// Those whose box meets the rows, in the order of their numbers.
  std::vector<BoxedTriangle> triangles;
};

/// The rows of the camera's image in bands, without triangles.
std::vector<RowBand> row_bands(const Camera& camera);

/// Adds to each band the triangles whose box meets it. By binary64 with bounds.
void add_certified_boxes(std::vector<RowBand>& bands, const TriangleSource& triangles,
                         const Camera& camera);
/// The same by exact numbers alone.
void add_exact_boxes(std::vector<RowBand>& bands, const TriangleSource& triangles,
                     const Camera& camera);

}  // namespace fathom
