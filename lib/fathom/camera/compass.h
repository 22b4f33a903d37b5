#pragma once

#include <array>

namespace fathom {

/// The direction of an azimuth and an elevation in degrees, as tables of the sun's position have
/// them: x east, y north, z up. (The azimuth of a View turns the other way.)
///
/// azimuth    clockwise from north, seen from above: 0 is +y, 90 is +x; any finite number.
/// elevation  above the horizon, −90 to 90.
/// Exact      (cos e·sin a, cos e·cos a, sin e), each number rounded once.
/// Fails      UsageError for an azimuth that is not finite and for another elevation.
std::array<double, 3> compass_direction(double azimuth, double elevation);

}  // namespace fathom
