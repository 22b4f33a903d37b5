#pragma once

#include <cstdint>

#include "fathom/numeric/real.h"

/// Numbers of angles, each rounded once: sines, cosines and focal lengths. Only for .cpp files.
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

/// The sine and cosine of any finite angle.
SineCosine sine_and_cosine(double degrees);

/// a·b, rounded once. The product of the rounded numbers has its sign, also where it is 0.
double rounded_product(const Signed& a, const Signed& b);

/// The focal length in pixels with which `size` pixels span an angle: ½·size / tan(½·angle), the
/// exact number rounded once. The angle is between 0 and 180 degrees.
double focal_of_degrees(std::uint32_t size, double angle);
/// The same of an angle in radians, between 0 and π.
double focal_of_radians(std::uint32_t size, double angle);

}  // namespace fathom::camera
