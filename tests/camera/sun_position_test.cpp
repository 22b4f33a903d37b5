// Positions of the sun, against published ones.
#include "fathom/camera/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

constexpr double accuracy = 0.01;

void expect_near(const SunPosition& found, double azimuth, double elevation) {
  EXPECT_NEAR(found.azimuth, azimuth, accuracy);
  EXPECT_NEAR(found.elevation, elevation, accuracy);
}

// NREL/TP-560-34302, table A5.1: 12:30:30 at UTC-7 on 17 October 2003 in Golden, Colorado. The
// elevation there includes refraction by 0.0163 degrees.
TEST(SunPosition, IsThatOfTheExampleOfNrel) {
  expect_near(sun_position({39.742476, -105.1786}, 1066419030), 194.340241,
              90 - 50.111622 - 0.016332);
}

// Meeus, Astronomical Algorithms, example 25.a: 13 October 1992, 0h dynamical time, 59 seconds
// ahead of UTC. Seen from the north pole the elevation is the declination.
TEST(SunPosition, IsThatOfTheExampleOfMeeus) {
  EXPECT_NEAR(sun_position({90, 0}, 718934341).elevation, -7.78507, accuracy);
}

// Equinoxes and solstices of 2026 as almanacs have them: 20 March 14:46, 21 June 08:25,
// 23 September 00:05 and 21 December 20:50 UTC.
TEST(SunPosition, HasTheDeclinationsOfTheSeasons) {
  EXPECT_NEAR(sun_position({90, 0}, 1774017960).elevation, 0, accuracy);
  EXPECT_NEAR(sun_position({90, 0}, 1782030300).elevation, 23.436, accuracy);
  EXPECT_NEAR(sun_position({90, 0}, 1790121900).elevation, 0, accuracy);
  EXPECT_NEAR(sun_position({-90, 0}, 1797886200).elevation, 23.436, accuracy);
}

// The sun rises in the east, and culminates in the south or in the north.
TEST(SunPosition, TurnsClockwiseFromNorth) {
  constexpr UnixSeconds noon = 1774008000;  // of the equinox of 2026, 12:00 UTC
  for (const double latitude : {50.0, -50.0}) {
    const double meridian = latitude > 0 ? 180 : 0;
    const SunPosition sun =
        sun_position({latitude, 0}, noon + 7 * 60 + 25);  // the equation of time
    EXPECT_NEAR(std::remainder(sun.azimuth - meridian, 360), 0, 0.1);
    EXPECT_NEAR(sun.elevation, 40, 0.1);
    EXPECT_NEAR(sun_position({latitude, 0}, noon - 6 * 3600).azimuth, 90, 3);
    EXPECT_NEAR(sun_position({latitude, 0}, noon + 6 * 3600).azimuth, 270, 3);
    EXPECT_NEAR(sun_position({latitude, 90}, noon - 6 * 3600 + 445).azimuth, sun.azimuth, 0.2);
  }
}

TEST(SunPosition, RefusesWhatItsFormulaDoesNotCover) {
  EXPECT_THROW(sun_position({90.5, 0}, 0), UsageError);
  EXPECT_THROW(sun_position({0, -181}, 0), UsageError);
  EXPECT_THROW(sun_position({NAN, 0}, 0), UsageError);
  EXPECT_THROW(sun_position({0, 0}, first_second_of_sun - 1), UsageError);
  EXPECT_THROW(sun_position({0, 0}, end_of_sun), UsageError);
  EXPECT_NO_THROW(sun_position({0, 0}, first_second_of_sun));
  EXPECT_NO_THROW(sun_position({0, 0}, end_of_sun - 1));
}

}  // namespace
}  // namespace fathom
