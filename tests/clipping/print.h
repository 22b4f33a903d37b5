#pragma once

#include <ostream>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"

namespace fathom::clipping {

/// For GoogleTest's messages.
inline void PrintTo(const Point2<Rational>& p, std::ostream* stream) {
  *stream << "(" << to_fraction(p.x) << ", " << to_fraction(p.y) << ")";
}

}  // namespace fathom::clipping
