#include <gtest/gtest.h>

#include <limits>

#include "fathom/camera/camera.h"

namespace fathom {
namespace {

TEST(ClipPlanes, AreThereWhereWindowDepthsAreDefined) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using enum ProjectionModel;
  const auto has = [](ProjectionModel projection, double near, double far) {
    return has_clip_planes({.projection = {.model = projection}, .near = near, .far = far});
  };
  for (const ProjectionModel projection : {perspective, orthographic}) {
    EXPECT_TRUE(has(projection, 0.1, 100));
    EXPECT_FALSE(has(projection, 0.1, infinity));
    EXPECT_FALSE(has(projection, 0, infinity));
  }
  // Depth 0 has a window depth only where it is not divided by.
  EXPECT_FALSE(has(perspective, 0, 100));
  EXPECT_TRUE(has(orthographic, 0, 100));
}

}  // namespace
}  // namespace fathom
