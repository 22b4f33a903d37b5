#include "fathom/camera/sun_position.h"

#include <cmath>
#include <numbers>

#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

constexpr double degree = std::numbers::pi / 180;
/// 2000-01-01 12:00, Julian date 2451545.0.
constexpr UnixSeconds epoch = 946728000;

double sine(double degrees) {
  return std::sin(degrees * degree);
}
double cosine(double degrees) {
  return std::cos(degrees * degree);
}
/// In [0, 360).
double turned(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

void require_in_range(const EarthPlace& place, UnixSeconds time) {
  if (!(std::abs(place.latitude) <= 90)) {
    throw UsageError("the latitude must be between -90 and 90 degrees");
  }
  if (!(std::abs(place.longitude) <= 180)) {
    throw UsageError("the longitude must be between -180 and 180 degrees");
  }
  if (time < first_second_of_sun || time >= end_of_sun) {
    throw UsageError("the time must be in the years 1950 to 2050");
  }
}

}  // namespace

SunPosition sun_position(const EarthPlace& place, UnixSeconds time) {
  const StandardArithmetic standard;
  require_in_range(place, time);
  const double n = static_cast<double>(time - epoch) / 86400;
  // Mean longitude, mean anomaly, ecliptic longitude, obliquity of the ecliptic.
  const double L = turned(280.460 + 0.9856474 * n);
  const double g = turned(357.528 + 0.9856003 * n);
  const double lambda = L + 1.915 * sine(g) + 0.020 * sine(2 * g);
  const double epsilon = 23.439 - 0.0000004 * n;
  // The sun in the frame of the equator: towards the equinox, 90 degrees east of it, north.
  const double equinox = cosine(lambda), east = cosine(epsilon) * sine(lambda),
               north = sine(epsilon) * sine(lambda);
  // Turned by the local sidereal time: towards the meridian, east, north.
  const double hours = turned(15 * 6.697375 + 15 * 0.0657098242 * n +
                              360 * (static_cast<double>((time - epoch) % 86400) / 86400 + 0.5));
  const double sidereal = hours + place.longitude;
  const double to_meridian = equinox * cosine(sidereal) + east * sine(sidereal),
               to_east = east * cosine(sidereal) - equinox * sine(sidereal);
  const double up = north * sine(place.latitude) + to_meridian * cosine(place.latitude),
               to_north = north * cosine(place.latitude) - to_meridian * sine(place.latitude);
  return {turned(std::atan2(to_east, to_north) / degree),
          std::atan2(up, std::hypot(to_east, to_north)) / degree};
}

std::array<double, 3> compass_direction(double azimuth, double elevation) {
  const StandardArithmetic standard;
  if (!std::isfinite(azimuth)) throw UsageError("the azimuth is not finite");
  if (!(elevation >= -90 && elevation <= 90)) {
    throw UsageError("the elevation must be between -90 and 90 degrees");
  }
  const camera::SineCosine a = camera::sine_and_cosine(azimuth),
                           e = camera::sine_and_cosine(elevation);
  return {camera::rounded_product(e.cosine, a.sine), camera::rounded_product(e.cosine, a.cosine),
          e.sine.rounded};
}

}  // namespace fathom
