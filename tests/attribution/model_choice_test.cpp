#include "fathom/attribution/model_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fathom/attribution/model/named_models.h"
#include "tests/attribution/sphere_maps.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Truth sphere(double near, double far) {
  return *test::sphere_seen_by(test::sphere_camera(near, far));
}

OtherMap in_codes(const Truth& truth, int bits) {
  return test::in_codes(truth, bits, truth.camera.near, truth.camera.far);
}

// Pixels are so small that a thousandth of one, by which Cycles may be off, is less than a code.
TEST(ModelChoice, SixteenBits) {
  const Truth truth = sphere(0.5, 20);
  const ModelChoice choice = chosen_model(truth, in_codes(truth, 16));
  EXPECT_EQ(choice.chosen.model.name, "gl-unorm16") << testing::PrintToString(choice.evidence);
  EXPECT_EQ(choice.chosen.attribution.count(PixelClass::unexplained), 0U);
  ASSERT_EQ(choice.evidence.size(), 7U);  // none of VTK's is needed
  EXPECT_THAT(choice.evidence[0],
              testing::StartsWith("gl-unorm16: every pixel is explained, bounds "));
}

// Of those that explain all, the one with the narrowest bounds.
TEST(ModelChoice, TheNarrowest) {
  const Truth truth = sphere(0.5, 20);
  const ModelChoice choice = chosen_model(truth, in_codes(truth, 52));
  const double width = choice.chosen.attribution.sharpness.median_relative_width;
  for (const RendererModel& model : named_models()) {
    const Attribution other = attribute(truth, in_codes(truth, 52), model);
    EXPECT_EQ(other.count(PixelClass::unexplained), 0U);
    EXPECT_LE(width, other.sharpness.median_relative_width) << model.name;
  }
}

TEST(ModelChoice, WithoutFarOnlyRays) {
  const Truth truth = sphere(0, infinity);
  const ModelChoice choice = chosen_model(truth, test::in_binary32(truth));
  EXPECT_EQ(choice.chosen.model.name, "float32-ray");
  EXPECT_EQ(choice.evidence.size(), 2U);
}

}  // namespace
}  // namespace fathom::attribution
