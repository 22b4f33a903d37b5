#pragma once

#include "fathom/numeric/dyadic.h"

/// Sines and cosines of binary64 angles in radians, each the multiple of 2^−bits nearest to the
/// true number. The sine and the cosine of a rational number other than 0 are transcendental
/// (Lindemann), so that none lies halfway between two multiples.
namespace fathom {

Dyadic sine_on_grid(double radians, long bits);
Dyadic cosine_on_grid(double radians, long bits);

}  // namespace fathom
