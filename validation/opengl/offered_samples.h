#pragma once

#include <vector>

#include "validation/variants/driver.h"

namespace fathom::validation {

/// The numbers of samples per pixel, more than one, that a driver offers for 24 bits of depth and
/// numbers of triangles beside them, in increasing order.
/// Needs    as an EglContext with a driver does.
/// Fails    InputError where there is no OpenGL or no such driver.
std::vector<int> offered_samples(Driver driver);

}  // namespace fathom::validation
