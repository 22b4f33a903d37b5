// The kernels that `fathom bench --parts` times, against what is known by hand and the slow judge.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "apps/bench/parts/edge_kernels.h"
#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/exact_picture.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::bench {
namespace {

/// A triangle by corners in pixels, which have to lie on the grid.
SnappedTriangle triangle(const std::array<std::array<double, 2>, 3>& corners,
                         const std::array<double, 3>& depths = {0.5, 0.5, 0.5}) {
  SnappedTriangle t{{}, depths};
  for (std::size_t k = 0; k < 3; ++k) {
    t.corners[k] = {static_cast<std::int64_t>(corners[k][0] * steps_per_pixel),
                    static_cast<std::int64_t>(corners[k][1] * steps_per_pixel)};
  }
  return t;
}

/// The pixels of the first triangle, row by row: "#" covered, "." not.
std::vector<std::string> drawn(const SnappedScene& scene, EdgeRule rule) {
  std::vector<std::string> rows;
  for (std::uint32_t y = 0; y < scene.height; ++y) {
    std::string& row = rows.emplace_back();
    for (std::uint32_t x = 0; x < scene.width; ++x)
      row += covers(scene.triangles[0], x, y, rule) ? '#' : '.';
  }
  return rows;
}

/// Triangles at random, of all sizes and both windings, that reach over the sides of the image.
/// Half of them have corners on the lattice of half pixels, so that edges run through centres.
SnappedScene random_scene(std::uint32_t width, std::uint32_t height, int count) {
  SnappedScene scene{width, height, {}};
  std::mt19937_64 random(1);
  const auto between = [&](std::int64_t a, std::int64_t b) {
    return a + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(b - a + 1));
  };
  for (int i = 0; i < count; ++i) {
    const std::int64_t step = i % 2 == 0 ? 128 : 1;
    const std::int64_t reach = i % 3 == 0 ? 3 * 256 : 40 * 256;
    const GridPlace centre{between(-256, 256 * (std::int64_t{width} + 1)),
                           between(-256, 256 * (std::int64_t{height} + 1))};
    SnappedTriangle& t = scene.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      t.corners[k] = {(centre.x + between(-reach, reach)) / step * step,
                      (centre.y + between(-reach, reach)) / step * step};
      t.depths[k] = static_cast<double>(random() % 1024) / 1024;
    }
  }
  return scene;
}

template <class Number>
Picture layers_by(const SnappedScene& scene, int lanes) {
  PaddedImage<Number> layers(scene.width, scene.height, 0);
  const std::vector<EdgeSetup> setups = set_up_edges(scene);
  if (lanes == 1) {
    add_boxes_one_by_one<Number>(setups, layers);
  } else {
    add_boxes(setups, lanes, layers);
  }
  return layers.picture();
}

// The hypotenuse runs through the centres of a diagonal. It is neither a left nor a top edge.
TEST(PartsJudge, CentresOnARightEdgeAreOutsideUnlessEdgesAreClosed) {
  const SnappedScene scene{5, 5, {triangle({{{0, 0}, {4, 0}, {0, 4}}})}};
  EXPECT_EQ(drawn(scene, EdgeRule::half_open),
            (std::vector<std::string>{"###..", "##...", "#....", ".....", "....."}));
  EXPECT_EQ(drawn(scene, EdgeRule::closed),
            (std::vector<std::string>{"####.", "###..", "##...", "#....", "....."}));
}

// For the other half of the square, the same line is a left edge.
TEST(PartsJudge, CentresOnALeftEdgeAreInside) {
  const SnappedScene scene{5, 5, {triangle({{{4, 0}, {0, 4}, {4, 4}}})}};
  EXPECT_EQ(drawn(scene, EdgeRule::half_open),
            (std::vector<std::string>{"...#.", "..##.", ".###.", "####.", "....."}));
}

// Corners on centres: of the level edges the upper one belongs to the triangle, the lower one not.
TEST(PartsJudge, TheTopEdgeIsInsideAndTheBottomEdgeIsNot) {
  const SnappedScene top{4, 4, {triangle({{{0.5, 0.5}, {3.5, 0.5}, {0.5, 3.5}}})}};
  EXPECT_EQ(drawn(top, EdgeRule::half_open),
            (std::vector<std::string>{"###.", "##..", "#...", "...."}));
  const SnappedScene bottom{4, 4, {triangle({{{0.5, 0.5}, {3.5, 3.5}, {0.5, 3.5}}})}};
  EXPECT_EQ(drawn(bottom, EdgeRule::half_open),
            (std::vector<std::string>{"....", "#...", "##..", "...."}));
}

TEST(PartsJudge, WithoutAreaNothingIsCovered) {
  const SnappedScene scene{4, 4, {triangle({{{0.5, 0.5}, {1.5, 1.5}, {3.5, 3.5}}})}};
  for (const EdgeRule rule : {EdgeRule::half_open, EdgeRule::closed})
    EXPECT_EQ(covered_pixels(scene, rule), 0U);
  EXPECT_TRUE(set_up_edges(scene).empty());
}

// A fan around a centre, over 8 × 8 pixels: its edges run through centres, and all are shared.
TEST(PartsJudge, SharedEdgesAreCoveredOnceOrIfClosedTwice) {
  const std::vector<std::array<double, 2>> rim{{0, 0}, {4, 0}, {8, 0}, {8, 4},
                                               {8, 8}, {4, 8}, {0, 8}, {0, 4}};
  SnappedScene scene{8, 8, {}};
  for (std::size_t i = 0; i < rim.size(); ++i)
    scene.triangles.push_back(triangle({{rim[i], rim[(i + 1) % rim.size()], {4.5, 4.5}}}));
  EXPECT_EQ(covered_pixels(scene, EdgeRule::half_open), 64U);
  // The diagonals through both corners: 4 + 3 centres; (4.5, 4.5) in all eight triangles.
  EXPECT_EQ(covered_pixels(scene, EdgeRule::closed), 64U + 4 + 3 + 7);
  for (SnappedTriangle& t : scene.triangles) std::swap(t.corners[0], t.corners[1]);
  EXPECT_EQ(covered_pixels(scene, EdgeRule::half_open), 64U);
}

TEST(PartsJudge, CountsTheDemoAsThePipelineAndThePlainProgramDo) {
  const std::vector<RuleCounts> demo = closed_edges_of_demo();
  ASSERT_EQ(demo.size(), 2U);
  const SnappedScene near{320, 240, {triangle({{{80, 30}, {30, 200}, {200, 180}}})}};
  const SnappedScene far{320, 240, {triangle({{{160, 20}, {100, 220}, {290, 150}}})}};
  EXPECT_EQ(demo[0].half_open, 13955U);
  EXPECT_EQ(demo[0].closed, 13955U);
  EXPECT_EQ(demo[1].half_open, 16830U);
  EXPECT_EQ(demo[1].closed, 16970U);
  for (const auto& [scene, counts] : {std::pair(near, demo[0]), std::pair(far, demo[1])}) {
    const RuleCounts own = closed_edges("", scene);
    EXPECT_EQ(own.half_open, counts.half_open);
    EXPECT_EQ(own.closed, counts.closed);
  }
}

TEST(PartsJudge, CoversThePixelsOfThePipeline) {
  const BenchScene bench = make_scene("sphere-2k", 160, 90);
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = pipeline::Shading::none;
  const auto frame = pipeline::render_frame(bench.scene, bench.camera, options, false);
  const SnappedScene scene = snapped(bench);
  EXPECT_EQ(covered_pixels(scene, EdgeRule::half_open), frame.statistics.fragments);
  const Picture nearest = exact_nearest(scene);
  for (std::size_t i = 0; i < frame.id.size(); ++i)
    ASSERT_EQ(nearest[i] == 1, frame.id[i] == no_surface) << "pixel " << i;
}

TEST(PartsKernels, Binary64IsExactWithAnyNumberOfLanes) {
  const SnappedScene scene = random_scene(61, 43, 3000);
  const Picture exact = exact_layers(scene);
  EXPECT_GT(*std::max_element(exact.begin(), exact.end()), 1000);
  for (const int lanes : {1, 2, 4, 8, 16})
    EXPECT_EQ(layers_by<double>(scene, lanes), exact) << lanes;
  PaddedImage<double> layers(scene.width, scene.height, 0);
  add_boxes_one_by_one<std::int64_t>(set_up_edges(scene), layers);
  EXPECT_EQ(layers.picture(), exact);
}

TEST(PartsKernels, ClosedEdgesAreThoseOfTheJudge) {
  const SnappedScene scene = random_scene(61, 43, 1000);
  PaddedImage<double> layers(scene.width, scene.height, 0);
  add_boxes(set_up_edges(scene, EdgeRule::closed), 8, layers);
  EXPECT_EQ(layers.picture(), exact_layers(scene, EdgeRule::closed));
  EXPECT_NE(layers.picture(), exact_layers(scene));
}

TEST(PartsKernels, Binary32IsExactWhereItHoldsTheNumbers) {
  SnappedScene scene = random_scene(61, 43, 3000);
  const std::vector<EdgeSetup> setups = set_up_edges(scene);
  std::vector<SnappedTriangle> small;
  for (const EdgeSetup& s : setups)
    if (s.fits_binary32()) small.push_back(scene.triangles[s.number]);
  scene.triangles = std::move(small);
  EXPECT_GT(scene.triangles.size(), 500U);
  EXPECT_LT(scene.triangles.size(), setups.size());
  const Picture exact = exact_layers(scene);
  for (const int lanes : {1, 2, 4, 8, 16})
    EXPECT_EQ(layers_by<float>(scene, lanes), exact) << lanes;
}

// An edge of 4000 pixels that misses a centre by 1 / 65536 of a square pixel.
TEST(PartsKernels, Binary32IsWrongBeyondThat) {
  SnappedScene scene{4096, 4, {}};
  for (std::int64_t y = 0; y < 256; ++y)
    scene.triangles.push_back({{{{0, y}, {4095 * 256 + 1, 3 * 256 + y / 2}, {17, 4 * 256}}}, {}});
  const Picture exact = exact_layers(scene);
  EXPECT_EQ(layers_by<double>(scene, 8), exact);
  const Picture rounded = layers_by<float>(scene, 8);
  EXPECT_NE(rounded, exact);
  for (const int lanes : {1, 2, 4, 16}) EXPECT_EQ(layers_by<float>(scene, lanes), rounded) << lanes;
  for (const EdgeSetup& s : set_up_edges(scene)) EXPECT_FALSE(s.fits_binary32());
}

TEST(PartsKernels, WhatBinary32Holds) {
  const auto fits = [](double size) {
    const SnappedScene scene{64, 64, {triangle({{{0, 0}, {size, 0}, {0, size}}})}};
    return set_up_edges(scene).at(0).fits_binary32();
  };
  // Twice the area is (256 · size)² steps: 2²² and 2²⁶.
  EXPECT_TRUE(fits(8));
  EXPECT_FALSE(fits(32));
}

TEST(PartsKernels, BlocksChangeNothing) {
  const SnappedScene scene = random_scene(61, 43, 3000);
  const std::vector<EdgeSetup> setups = set_up_edges(scene);
  const Picture exact = exact_layers(scene);
  PaddedImage<double> one(scene.width, scene.height, 0), eight(scene.width, scene.height, 0);
  const BlockCounts by_one = add_blocks_one_by_one(setups, one);
  const BlockCounts by_eight = add_blocks(setups, eight);
  EXPECT_EQ(one.picture(), exact);
  EXPECT_EQ(eight.picture(), exact);
  EXPECT_EQ(by_one.tested, by_eight.tested);
  EXPECT_EQ(by_one.pixels_tested, by_eight.pixels_tested);
  EXPECT_GT(by_one.outside, 0U);
  EXPECT_GT(by_one.inside, 0U);
}

// 24 × 24 pixels, halved by the diagonal from the lower left: of nine blocks three lie on it, three
// above are inside, three below are outside.
TEST(PartsKernels, BlocksAreCountedByHand) {
  const SnappedScene scene{24, 24, {triangle({{{0, 0}, {24, 0}, {0, 24}}})}};
  PaddedImage<double> layers(24, 24, 0);
  const BlockCounts counts = add_blocks(set_up_edges(scene), layers);
  EXPECT_EQ(counts.tested, 9U);
  EXPECT_EQ(counts.inside, 3U);
  EXPECT_EQ(counts.outside, 3U);
  EXPECT_EQ(counts.pixels_tested, 3U * 64);
}

Picture picture_of(const DepthImage& image) {
  Picture picture = image.depths.picture();
  const Picture numbers = image.numbers.picture();
  picture.insert(picture.end(), numbers.begin(), numbers.end());
  return picture;
}

TEST(PartsKernels, TheNearestIsSeenAndOfEquallyNearOnesTheFirst) {
  const std::array<std::array<double, 2>, 3> left{{{0, 0}, {2, 0}, {0, 2}}};
  const SnappedScene scene{
      2,
      2,
      {triangle(left, {0.5, 0.5, 0.5}), triangle(left, {0.25, 0.25, 0.25}),
       triangle(left, {0.25, 0.25, 0.25}), triangle({{{0, 0}, {2, 0}, {2, 2}}}, {0, 1, 0})}};
  // Triangle 3 has depth x/2 − y/2: 0 at (0.5, 0.5), which lies on its left edge, 0.5 at (1.5, 0.5)
  // and 0 at (1.5, 1.5).
  Picture nearest = exact_nearest(scene);
  const Picture by_hand{0, 0.5, 1, 0,  //
                        4, 4,   0, 4};
  EXPECT_EQ(nearest, by_hand);
  SnappedScene first_three = scene;
  first_three.triangles.pop_back();
  nearest = exact_nearest(first_three);
  EXPECT_EQ(nearest, (Picture{0.25, 1, 1, 1,  //
                              2, 0, 0, 0}));
  DepthImage image(2, 2);
  draw_nearest(set_up_edges(first_three), image);
  EXPECT_EQ(picture_of(image), nearest);
  image.clear(0, 0);
  draw_nearest(set_up_edges(scene), image);
  EXPECT_EQ(picture_of(image), by_hand);
}

TEST(PartsKernels, TilesAndThreadsChangeNothing) {
  const SnappedScene scene = random_scene(131, 77, 2000);
  const std::vector<EdgeSetup> setups = set_up_edges(scene);
  const Picture exact = exact_nearest(scene);
  DepthImage image(scene.width, scene.height);
  draw_nearest(setups, image);
  EXPECT_EQ(picture_of(image), exact);
  for (const std::uint32_t side : {8U, 16U, 64U, 256U}) {
    for (const int threads : {1, 2, 3}) {
      DepthImage in_tiles(scene.width, scene.height);
      const TileCounts counts = draw_in_tiles(setups, side, threads, in_tiles);
      EXPECT_EQ(picture_of(in_tiles), exact) << side << " " << threads;
      EXPECT_EQ(counts.tiles, ((131 + side - 1) / side) * ((77 + side - 1) / side));
      EXPECT_GE(counts.pairs, setups.size());
      EXPECT_GE(counts.most_of_a_thread * static_cast<std::uint64_t>(threads), counts.tiles);
      if (side == 256) {
        EXPECT_EQ(counts.pairs, setups.size());
      }
    }
  }
}

TEST(PartsKernels, AVectorHasAsManyLanesAsFit) {
  EXPECT_THAT(lanes_of_a_vector<float>(), testing::AnyOf(1, 4, 8, 16));
  EXPECT_THAT(lanes_of_a_vector<double>(), testing::AnyOf(1, 2, 4, 8));
}

}  // namespace
}  // namespace fathom::bench
