#pragma once

#include "fathom/numeric/real.h"

/// Sines and cosines of any finite angle in degrees, shared by camera_making.h and compass.h.
namespace fathom::camera {

/// A sine or cosine: its magnitude, and itself, rounded once.
struct Signed {
  Real magnitude;
  double rounded;

  Signed operator-() const { return {magnitude, -rounded}; }
};

struct SineCosine {
  Signed sine, cosine;
};

SineCosine sine_and_cosine(double degrees);

/// a·b, rounded once. The product of the rounded numbers has its sign, also where it is 0.
double rounded_product(const Signed& a, const Signed& b);

}  // namespace fathom::camera
