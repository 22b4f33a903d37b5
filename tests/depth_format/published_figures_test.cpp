// Figures that others have published, recomputed; docs/studies.md lists them with their sources.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "fathom/depth_format/depth_bias.h"
#include "fathom/depth_format/resolution.h"

namespace fathom {
namespace {

std::string two_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", x);
  return text;
}

double step_at(const DepthFormat& format, double depth) {
  const Resolution r = resolution(format, Dyadic(depth));
  return std::max(r.to_nearer.value_or(0), r.to_farther.value_or(0));
}

/// B. Kemen, Logarithmic Depth Buffer, 2009: metres that 24 bits resolve, far at 10,000 km.
TEST(PublishedFigures, KemensTable) {
  struct Row {
    double depth;
    const char *c_1, *c_001;
  };
  const std::vector<Row> table{{1, "1.9e-06", "5.5e-04"},   {10, "1.1e-05", "5.5e-04"},
                               {100, "9.7e-05", "6.0e-04"}, {1e3, "9.6e-04", "1.1e-03"},
                               {1e4, "9.6e-03", "6.0e-03"}, {1e5, "9.6e-02", "5.5e-02"},
                               {1e6, "9.6e-01", "5.5e-01"}, {1e7, "9.6e+00", "5.5e+00"}};
  for (const Row& row : table) {
    EXPECT_EQ(two_digits(step_at({Mapping::log, Storage::unorm24, 0.1, 1e7}, row.depth)), row.c_1);
    EXPECT_EQ(two_digits(step_at({Mapping::log, Storage::unorm24, 0.1, 1e7, 0.001}, row.depth)),
              row.c_001);
  }
}

double share_up_to(const DepthFormat& format, double depth) {
  const Ratio near = Dyadic(format.near), far = Dyadic(format.far);
  return static_cast<double>(codes_between(format, near, Dyadic(depth))) /
         static_cast<double>(codes_between(format, near, far));
}

/// SGI's course of 1999: at least half of the resolution lies within twice near. f(2·near) is
/// far/(2·(far − near)), so it is a little more for every far.
TEST(PublishedFigures, HalfOfTheCodesLieWithinTwiceNear) {
  for (const double far : {2.5, 10.0, 1000.0, 1e9}) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::unorm32}) {
      EXPECT_GE(share_up_to({Mapping::standard, storage, 1, far}, 2), 0.5);
    }
  }
}

/// glFrustum's reference: about log2(far/near) bits are lost. Exactly so at far, against linear; at
/// near as many are gained.
TEST(PublishedFigures, BitsLostToTheRatioOfFarAndNear) {
  const DepthFormat standard{Mapping::standard, Storage::unorm24, 1, 1024};
  const DepthFormat linear{Mapping::linear, Storage::unorm24, 1, 1024};
  // A step next to far is D·D'·…, not far²·…: smaller by less than 1024 steps of 2⁻²⁴, as at near.
  const double at_far = step_at(standard, 1024) / step_at(linear, 1024);
  EXPECT_GT(at_far, 1024 * (1 - 0x1p-13));
  EXPECT_LT(at_far, 1024);
  const double at_near = step_at(standard, 1) / step_at(linear, 1);
  EXPECT_LT(at_near, (1 + 0x1p-13) / 1024);
  EXPECT_GT(at_near, 1.0 / 1024);
}

/// 0.0001 of *window* depth is no z-fighting: 6.55 steps of unorm16.
TEST(PublishedFigures, StepsInWindowDepth) {
  const Ratio steps = Ratio(Dyadic(1.0), Dyadic(10000.0)) * Dyadic(65535.0);
  EXPECT_EQ(to_decimal(steps, 5), "6.5535e0");
}

/// D²/(near·2ⁿ), as often quoted, is too coarse where a step is no small part of the depth.
TEST(PublishedFigures, TheSquareFormulaAtFar) {
  const auto quoted = [](double depth, int bits) { return depth * depth / std::ldexp(0.1, bits); };
  EXPECT_EQ(two_digits(quoted(1000, 16)), "1.5e+02");
  EXPECT_EQ(two_digits(step_at({Mapping::standard, Storage::unorm16, 0.1, 1000}, 1000)), "1.3e+02");
  EXPECT_EQ(two_digits(quoted(10, 24)), "6.0e-05");
  EXPECT_EQ(two_digits(step_at({Mapping::standard, Storage::unorm24, 0.1, 1000}, 10)), "6.0e-05");
}

}  // namespace
}  // namespace fathom
