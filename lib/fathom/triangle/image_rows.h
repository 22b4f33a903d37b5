#pragma once

#include <array>

#include "fathom/camera/camera.h"
#include "fathom/mesh/object.h"

namespace fathom::triangle {

/// U, V and W of the image of a point of an object's mesh, as exact affine functions of that point:
/// the coefficients of x, y, z and 1.
std::array<std::array<Dyadic, 4>, 3> image_rows(const Object& object, const Camera& camera);

}  // namespace fathom::triangle
