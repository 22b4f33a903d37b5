#pragma once

#include <array>
#include <cstdint>

/// Directions in the sky: of the sun, and of an azimuth and an elevation.
namespace fathom {

/// A place on the Earth, in degrees; north and east are positive.
struct EarthPlace {
  double latitude = 0, longitude = 0;
};

/// The direction towards the sun, in degrees.
struct SunPosition {
  /// Clockwise from north, seen from above: 0 is north, 90 is east; at least 0, below 360.
  double azimuth = 0;
  /// Above the horizon.
  double elevation = 0;
};

/// Seconds since 1970-01-01 00:00 UTC, without leap seconds.
using UnixSeconds = std::int64_t;

/// The times at which sun_position() keeps its accuracy: from the beginning of 1950 until before
/// the beginning of 2051.
inline constexpr UnixSeconds first_second_of_sun = -631152000, end_of_sun = 2556144000;

/// Where the sun stands, by the low-precision formula of the Astronomical Almanac.
///
/// Accuracy 0.01 degrees in the years 1950 to 2050 for the direction towards the centre of the sun
///          from the centre of the Earth. Neither the refraction of the air, which raises the sun
///          by up to 0.6 degrees at the horizon, nor its parallax of 0.0024 degrees is included.
///          The azimuth is undefined, and 0, at the zenith, and inaccurate next to it.
/// Computed in binary64 by the C library's sines: not exact, unlike most of this library.
/// Fails    UsageError for a latitude outside [−90, 90], a longitude outside [−180, 180] and a time
///          outside these years.
/// Source   [Mic88]
SunPosition sun_position(const EarthPlace& place, UnixSeconds time);

/// The direction of an azimuth and an elevation in degrees, as tables of the sun's position have
/// them: x east, y north, z up. (The azimuth of a View turns the other way.)
///
/// azimuth    clockwise from north, seen from above: 0 is +y, 90 is +x; any finite number.
/// elevation  above the horizon, −90 to 90.
/// Exact      (cos e·sin a, cos e·cos a, sin e), each number rounded once.
/// Fails      UsageError for an azimuth that is not finite and for another elevation.
std::array<double, 3> compass_direction(double azimuth, double elevation);

}  // namespace fathom
