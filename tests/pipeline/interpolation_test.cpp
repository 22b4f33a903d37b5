#include <gtest/gtest.h>

#include <cmath>

#include "fathom/pipeline/fragments/fragment.h"

namespace fathom::pipeline {
namespace {

/// A triangle (0, 0), (8, 0), (0, 8) in the window; corners at depths 1, 2 and 4, so that w is the
/// depth, and texture coordinates that are a corner's own.
WindowTriangle<double> slanted() {
  WindowTriangle<double> t;
  const double places[3][2] = {{0, 0}, {8, 0}, {0, 8}}, depths[3] = {1, 2, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    WindowVertex<double>& c = t.corners[i];
    c.x = places[i][0];
    c.y = places[i][1];
    c.z = 0.25 * static_cast<double>(i);
    c.inverse_w = 1 / depths[i];
    c.attributes.fill(0);
    c.attributes[attribute::depth] = depths[i];
    c.attributes[attribute::uv] = i == 1 ? 1 : 0;
    c.attributes[attribute::uv + 1] = i == 2 ? 1 : 0;
  }
  return t;
}

TEST(Interpolation, WindowDepthIsAffineAndDepthIsNot) {
  const WindowTriangle<double> t = slanted();
  const auto interpolator = Interpolator<double>::of(t, {});
  ASSERT_TRUE(interpolator);
  // The middle of the side from A to B.
  const GridPoint middle{4 * grid_one, 0};
  const auto linear = interpolator->linear_weights(middle);
  EXPECT_EQ(linear, (std::array<double, 3>{0.5, 0.5, 0}));
  const Fragment fragment = interpolator->depths_at(middle);
  EXPECT_EQ(fragment.window_z, 0.125);
  // 1/D is affine: ½(1 + ½) = ¾.
  EXPECT_DOUBLE_EQ(fragment.depth, 4.0 / 3);
  const auto weights = interpolator->attribute_weights(middle);
  EXPECT_DOUBLE_EQ(weights[0], 2.0 / 3);
  EXPECT_DOUBLE_EQ(weights[1], 1.0 / 3);
}

TEST(Interpolation, AffineAttributesWhereThatIsAskedFor) {
  const WindowTriangle<double> t = slanted();
  PipelineOptions options;
  options.interpolation = Interpolation::affine;
  const auto interpolator = Interpolator<double>::of(t, options);
  ASSERT_TRUE(interpolator);
  const GridPoint middle{4 * grid_one, 0};
  Fragment fragment = interpolator->depths_at(middle);
  interpolator->complete(fragment, middle);
  EXPECT_DOUBLE_EQ(fragment.depth, 4.0 / 3);  // as ever
  EXPECT_EQ(fragment.attributes[attribute::uv], 0.5);
  EXPECT_EQ(fragment.duv_dx[0], 0.125);  // a pixel to the right: 5/8
  EXPECT_EQ(fragment.duv_dy[0], 0);
  EXPECT_EQ(fragment.duv_dy[1], 0.125);
}

TEST(Interpolation, TheOffsetMovesWindowDepthWithinItsRange) {
  WindowTriangle<double> t = slanted();
  t.depth_offset = 0.25;
  const GridPoint corner{0, 0};
  EXPECT_EQ(Interpolator<double>::of(t, {})->depths_at(corner).window_z, 0.25);
  t.depth_offset = -1;
  EXPECT_EQ(Interpolator<double>::of(t, {})->depths_at(corner).window_z, 0);
}

TEST(Interpolation, NothingIsLeftWhereSnappingLeavesNoArea) {
  WindowTriangle<double> t = slanted();
  t.corners[1].x = 0.001;
  t.corners[2].y = 0.001;
  EXPECT_FALSE(Interpolator<double>::of(t, {}));
}

/// What one pixel to the right and one below have more, of each coordinate; and every attribute.
TEST(Interpolation, ChangesAreDifferencesToTheNeighbours) {
  WindowTriangle<double> t = slanted();
  const double uvs[3][2] = {{0.1, 0.7}, {0.9, 0.2}, {0.4, 0.5}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < attribute::of_fragments; ++k) {
      t.corners[i].attributes[k] = static_cast<double>((7 * i + 3 * k) % 11);
    }
    t.corners[i].attributes[attribute::depth] = 1 / t.corners[i].inverse_w;
    for (std::size_t k = 0; k < 2; ++k) t.corners[i].attributes[attribute::uv + k] = uvs[i][k];
  }
  const auto interpolator = Interpolator<double>::of(t, {});
  ASSERT_TRUE(interpolator);
  const auto at = [&](std::int64_t x, std::int64_t y) {
    Fragment f;
    interpolator->complete(f, {x * grid_one, y * grid_one});
    return f;
  };
  const Fragment here = at(2, 3), right = at(3, 3), below = at(2, 4);
  // λ = (3/8, 2/8, 3/8), over depths 1, 2, 4.
  const double w[3] = {3. / 8, 1. / 8, 3. / 32}, sum = 3. / 8 + 1. / 8 + 3. / 32;
  for (std::size_t k = 0; k < attribute::of_fragments; ++k) {
    double value = 0;
    for (std::size_t i = 0; i < 3; ++i) value += w[i] / sum * t.corners[i].attributes[k];
    EXPECT_NEAR(here.attributes[k], value, 1e-14);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t uv = attribute::uv + k;
    EXPECT_NEAR(here.duv_dx[k], right.attributes[uv] - here.attributes[uv], 1e-15);
    EXPECT_NEAR(here.duv_dy[k], below.attributes[uv] - here.attributes[uv], 1e-15);
    EXPECT_GT(std::abs(here.duv_dx[k]), 1e-3);
    EXPECT_GT(std::abs(here.duv_dy[k]), 1e-3);
  }
}

}  // namespace
}  // namespace fathom::pipeline
