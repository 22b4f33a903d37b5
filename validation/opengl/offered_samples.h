#pragma once

#include <vector>

namespace fathom::validation {

/// The numbers of samples per pixel, more than one, that the driver offers for 24 bits of depth and
/// numbers of triangles beside them, in increasing order.
/// Fails    InputError where there is no OpenGL 4.5.
std::vector<int> offered_samples();

}  // namespace fathom::validation
