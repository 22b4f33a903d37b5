#pragma once

#include <cstdint>

#include "fathom/camera/camera.h"
#include "fathom/numeric/ratio.h"

/// Where a pixel is sampled, and which depths count (specification, sections 2 and 5).
namespace fathom {

/// The sample of a pixel: its centre.
inline ImagePoint centre_of_pixel(std::uint32_t column, std::uint32_t row) {
  return {column + 0.5, row + 0.5};
}

/// D > 0 and near ≤ D ≤ far, exactly.
bool is_in_range(const Ratio& depth, const Camera& camera);

}  // namespace fathom
