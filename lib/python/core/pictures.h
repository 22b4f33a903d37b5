#pragma once

#include <pybind11/numpy.h>

#include "fathom/image/rgb_image.h"

namespace fathom::python {

/// uint8, height × width × 3, that owns its memory.
pybind11::array array_of(const RgbImage& picture);

}  // namespace fathom::python
