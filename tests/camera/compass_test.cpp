// Directions of azimuth and elevation, against MPFR and at angles with known sines.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <random>

#include "fathom/camera/sun_position.h"
#include "fathom/failures/errors.h"

namespace fathom {
namespace {

using Direction = std::array<double, 3>;

/// The sine (or cosine) of an angle in degrees, at 500 bits.
void set_of_degrees(mpfr_ptr x, double degrees, bool is_sine) {
  mpfr_t angle;
  mpfr_init2(angle, 500);
  mpfr_const_pi(angle, MPFR_RNDN);
  mpfr_mul_d(angle, angle, degrees, MPFR_RNDN);
  mpfr_div_ui(angle, angle, 180, MPFR_RNDN);
  is_sine ? mpfr_sin(x, angle, MPFR_RNDN) : mpfr_cos(x, angle, MPFR_RNDN);
  mpfr_clear(angle);
}

TEST(Compass, AlongTheAxes) {
  EXPECT_EQ(compass_direction(0, 0), (Direction{0, 1, 0}));
  EXPECT_EQ(compass_direction(90, 0), (Direction{1, 0, 0}));
  EXPECT_EQ(compass_direction(180, 0), (Direction{0, -1, 0}));
  EXPECT_EQ(compass_direction(-90, 0), (Direction{-1, 0, 0}));
  EXPECT_EQ(compass_direction(630, 0), (Direction{-1, 0, 0}));
  EXPECT_EQ(compass_direction(17, 90), (Direction{0, 0, 1}));
  EXPECT_EQ(compass_direction(17, -90), (Direction{0, 0, -1}));
  EXPECT_EQ(compass_direction(45, 45)[0], 0.5);
  EXPECT_EQ(compass_direction(30, 0)[0], 0.5);
  EXPECT_EQ(compass_direction(0, 30)[2], 0.5);
}

TEST(Compass, RoundsOnce) {
  std::mt19937_64 random(23);
  mpfr_t expected, factor;
  mpfr_inits2(500, expected, factor, nullptr);
  for (int i = 0; i < 200; ++i) {
    const double azimuth = std::ldexp(static_cast<double>(random() % 720000), -3) / 100 - 360;
    const double elevation = static_cast<double>(random() % 180001) / 1000 - 90;
    SCOPED_TRACE(::testing::Message() << azimuth << ' ' << elevation);
    const Direction found = compass_direction(azimuth, elevation);
    for (const bool east : {true, false}) {
      set_of_degrees(expected, azimuth, east);
      set_of_degrees(factor, elevation, false);
      mpfr_mul(expected, expected, factor, MPFR_RNDN);
      EXPECT_EQ(found[east ? 0 : 1], mpfr_get_d(expected, MPFR_RNDN));
    }
    set_of_degrees(expected, elevation, true);
    EXPECT_EQ(found[2], mpfr_get_d(expected, MPFR_RNDN));
  }
  mpfr_clears(expected, factor, nullptr);
}

TEST(Compass, RefusesOtherAngles) {
  EXPECT_THROW(compass_direction(INFINITY, 0), UsageError);
  EXPECT_THROW(compass_direction(0, 90.5), UsageError);
  EXPECT_THROW(compass_direction(0, -91), UsageError);
  EXPECT_THROW(compass_direction(0, NAN), UsageError);
}

}  // namespace
}  // namespace fathom
