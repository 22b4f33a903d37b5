#pragma once

#include <cstdint>

/// Only for .cpp files of this room and of scene/.
namespace fathom::camera {

/// The focal length in pixels with which `size` pixels span an angle: ½·size / tan(½·angle), the
/// exact number rounded once. The angle is between 0 and 180 degrees.
double focal_of_degrees(std::uint32_t size, double angle);
/// The same of an angle in radians, between 0 and π.
double focal_of_radians(std::uint32_t size, double angle);

}  // namespace fathom::camera
