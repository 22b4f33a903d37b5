#pragma once

#include <cstddef>

#include "fathom/lens/exact_direction.h"

namespace fathom::lens {

/// The component of this number as a linear form: 0 is x.
ExactVector3 component(std::size_t k);

/// The greatest of |d_x|, |d_y| and |d_z|, as a linear form at d: a component or its negative. The
/// first of equal components.
ExactVector3 greatest_component(const ExactDirection& d);

}  // namespace fathom::lens
