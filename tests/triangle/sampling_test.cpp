#include <gtest/gtest.h>

#include <cmath>

#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using namespace triangle;

TEST(Sampling, PixelsAreSampledAtTheirCentres) {
  const ImagePoint s = centre_of_pixel(3, 4000000000U);
  EXPECT_EQ(s.u, 3.5);
  EXPECT_EQ(s.v, 4000000000.5);
}

TEST(Sampling, TheEndsOfTheRangeCountAndZeroDoesNot) {
  Camera camera = checks::camera_of(4, 4, 1);
  const auto counts = [&](const Ratio& depth) { return is_in_range(depth, camera); };
  EXPECT_FALSE(counts(Ratio()));
  EXPECT_FALSE(counts(Ratio(-1.0, 3.0)));
  EXPECT_TRUE(counts(Ratio(Dyadic(5e-324), Dyadic(3.0))));  // far is infinite
  EXPECT_TRUE(counts(Ratio(Dyadic(1e300) * Dyadic(1e300))));
  camera.near = 1;
  camera.far = 3;
  EXPECT_TRUE(counts(Ratio(3.0, 3.0)));
  EXPECT_TRUE(counts(Ratio(9.0, 3.0)));
  EXPECT_FALSE(counts(Ratio(std::nextafter(3.0, 0), 3.0)));
  EXPECT_FALSE(counts(Ratio(std::nextafter(9.0, 10), 3.0)));
}

}  // namespace
}  // namespace fathom
