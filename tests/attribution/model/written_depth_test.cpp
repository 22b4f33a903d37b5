#include <gtest/gtest.h>

#include <cmath>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

// Near, in the middle and far of 0.5 to 20. Beside log2: a product and a sum, u/ln 2 each in the
// logarithm, and a product, u of the depth.
TEST(WrittenDepths, AllowWhatTheShadingLanguageAllowsToLog2AndLittleMore) {
  constexpr double u = unit_roundoff<float>;
  EXPECT_EQ(log2_error(0.25), 0x1p-21);
  EXPECT_EQ(log2_error(-10), 60 * u);
  const WrittenDepth shader =
      written_depth(ProjectionModel::perspective, Mapping::log_ulrich, 0.5, 20);
  for (const double depth : {0.6, 3.0, 19.0}) {
    const double q = 1 / depth, z = shader.value(q), logarithm = z / shader.scale;
    EXPECT_NEAR(z, std::log(depth / 0.5) / std::log(40), 1e-7);  // its constants are binary32
    const double least = std::abs(shader.scale) * log2_error(logarithm);
    const double most = std::abs(shader.scale) * (log2_error(logarithm) + 3 * u) + 1.01 * u * z;
    const Interval allowed = shader.values(q, 0);
    for (const double width : {z - allowed.lower, allowed.upper - z}) {
      EXPECT_GE(width, least);
      EXPECT_LE(width, most);
    }
  }
}

TEST(WrittenDepths, OfReversedMappingsAreTheirs) {
  const WrittenDepth perspective =
      written_depth(ProjectionModel::perspective, Mapping::reversed, 0.5, 20);
  EXPECT_TRUE(perspective.of_w);
  EXPECT_NEAR(perspective.value(1 / 0.5), 1, 1e-7);  // its constants are binary32
  EXPECT_NEAR(perspective.value(1 / 20.0), 0, 1e-7);
  const WrittenDepth orthographic =
      written_depth(ProjectionModel::orthographic, Mapping::reversed, 0.5, 20);
  EXPECT_FALSE(orthographic.of_w);
  EXPECT_EQ(orthographic.value(0.25), 0.75);
  EXPECT_THROW(written_depth(ProjectionModel::perspective, Mapping::log_ulrich, 0, 20), InputError);
}

}  // namespace
}  // namespace fathom::attribution
