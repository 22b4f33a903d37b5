#include "fathom/pipeline/geometry/window_transform.h"

#include <gtest/gtest.h>

#include "fathom/image/depth_map.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

using clipping::Volume;

ClipVertex<double> corner(double x, double y, double z, double w, double depth = 0) {
  ClipVertex<double> v{{x, y, z, w}, std::vector<double>(attribute::count, 0.0)};
  v.attributes[attribute::depth] = depth;
  return v;
}

TEST(ClipTriangle, WhatLiesInsideComesOutAsItIs) {
  const std::vector<ClipVertex<double>> inside{corner(0, 0, 0.5, 1), corner(1, 0, 0, 1),
                                               corner(0, 1, 1, 1)};
  const auto polygon = clip_triangle(inside, Volume::zero_one);
  ASSERT_EQ(polygon.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(polygon[i].position.x, inside[i].position.x);
    EXPECT_EQ(polygon[i].position.z, inside[i].position.z);
  }
  EXPECT_TRUE(clip_triangle<double>({corner(2, 0, 0, 1), corner(3, 0, 0, 1), corner(2, 1, 0, 1)},
                                    Volume::zero_one)
                  .empty());
}

/// A corner behind the eye is cut off at near: of three corners four become, all with w > 0.
TEST(ClipTriangle, CornersBehindTheEyeAreCutOff) {
  // z = w − 1 (near at w = 1), the third corner at w = −1.
  const auto polygon = clip_triangle<double>(
      {corner(0, 0, 1, 2, 2), corner(1, 0, 1, 2, 2), corner(0, 0, -2, -1, -1)}, Volume::zero_one);
  ASSERT_EQ(polygon.size(), 4U);
  int at_near = 0;
  for (const auto& v : polygon) {
    EXPECT_GT(v.position.w, 0);
    EXPECT_GE(v.position.z, 0);
    EXPECT_DOUBLE_EQ(v.attributes[attribute::depth], v.position.w);  // attributes go with them
    at_near += v.position.z == 0;
  }
  EXPECT_EQ(at_near, 2);
}

TEST(ClipLine, IsCutAtBothEnds) {
  const auto line = clip_line(corner(-3, 0, 0.5, 1, 0), corner(3, 0, 0.5, 1, 6), Volume::zero_one);
  ASSERT_TRUE(line);
  EXPECT_DOUBLE_EQ((*line)[0].position.x, -1);
  EXPECT_DOUBLE_EQ((*line)[1].position.x, 1);
  EXPECT_DOUBLE_EQ((*line)[0].attributes[attribute::depth], 2);
  EXPECT_DOUBLE_EQ((*line)[1].attributes[attribute::depth], 4);
  EXPECT_FALSE(clip_line(corner(-3, 2, 0, 1), corner(3, 2, 0, 1), Volume::zero_one));
  EXPECT_FALSE(clip_line(corner(-3, 0, 0, 1), corner(0, 3, 0, 1), Volume::zero_one));  // past it
  // OpenGL's volume reaches down to z = −w.
  EXPECT_FALSE(is_inside(corner(0, 0, -1, 1), Volume::zero_one));
  EXPECT_TRUE(is_inside(corner(0, 0, -1, 1), Volume::opengl));
  EXPECT_FALSE(is_inside(corner(0, 0, 0, 0), Volume::opengl));
}

TEST(Viewport, CornersOfTheSquareAreThoseOfTheRectangle) {
  const Camera camera = checks::camera_of(100, 80, 1);
  PipelineOptions options;
  options.viewport = WindowRectangle{10, 20, 40, 30};  // from the lower left
  options.depth_range = {0.25, 0.75};
  options.depth_format.mapping = Mapping::opengl;
  const Viewport viewport = viewport_of(camera, options);
  const auto lower_left = viewport(divide(corner(-2, -2, -2, 2)));
  EXPECT_EQ(lower_left.x, 10);
  EXPECT_EQ(lower_left.y, 60);  // 80 − 20
  EXPECT_EQ(lower_left.z, 0.25);
  EXPECT_EQ(lower_left.inverse_w, 0.5);
  const auto upper_right = viewport(divide(corner(4, 4, 4, 4)));
  EXPECT_EQ(upper_right.x, 50);
  EXPECT_EQ(upper_right.y, 30);
  EXPECT_EQ(upper_right.z, 0.75);
  EXPECT_TRUE(is_stretched(camera, options));  // 4 : 3 is not 5 : 4
  options.viewport = WindowRectangle{-50, 0, 200, 160};
  EXPECT_FALSE(is_stretched(camera, options));
  options.viewport.reset();
  EXPECT_FALSE(is_stretched(camera, options));
}

}  // namespace
}  // namespace fathom::pipeline
