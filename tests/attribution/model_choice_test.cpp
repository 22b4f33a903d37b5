#include "fathom/attribution/model_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/camera_making.h"
#include "validation/bench/shapes.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Truth sphere(double near, double far) {
  Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3,
                            {.width = 160, .height = 120, .vertical_fov = 45});
  camera.near = near;
  camera.far = far;
  return make_truth(bench::as_scene({bench::sphere(128)}, "sphere"), camera);
}

/// The exact depths, stored as window depths of so many bits and read in binary32.
OtherMap in_codes(const Truth& truth, int bits) {
  const WindowDepth window =
      window_depth(Projection::perspective, Mapping::opengl, truth.camera.near, truth.camera.far);
  const double greatest = std::exp2(bits) - 1;
  OtherMap map{.width = truth.camera.width, .height = truth.camera.height, .depths = truth.depths};
  for (double& depth : map.depths) {
    if (!(depth < infinity)) continue;
    const double code = std::nearbyint(window.of_depth(depth) * greatest);
    depth = double{static_cast<float>(window.to_depth(code / greatest))};
  }
  return map;
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
  const double width = choice.chosen.attribution.median_relative_width;
  for (const RendererModel& model : named_models()) {
    const Attribution other = attribute(truth, in_codes(truth, 52), model);
    EXPECT_EQ(other.count(PixelClass::unexplained), 0U);
    EXPECT_LE(width, other.median_relative_width) << model.name;
  }
}

TEST(ModelChoice, WithoutFarOnlyRays) {
  const Truth truth = sphere(0, infinity);
  OtherMap map{.width = 160, .height = 120, .depths = truth.depths};
  for (double& depth : map.depths) depth = double{static_cast<float>(depth)};
  const ModelChoice choice = chosen_model(truth, map);
  EXPECT_EQ(choice.chosen.model.name, "float32-ray");
  EXPECT_EQ(choice.evidence.size(), 2U);
}

}  // namespace
}  // namespace fathom::attribution
