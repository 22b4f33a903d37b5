// The figures of the study `course` against what can be known about them.

#include <gtest/gtest.h>

#include "validation/studies/course/back_faces.h"
#include "validation/studies/course/demo.h"
#include "validation/studies/course/exercises.h"
#include "validation/studies/course/shared_edges.h"

namespace fathom::studies {
namespace {

TEST(Course, TablesAreThoseOfTheSource) {
  const Tables t = z_buffer_tables();
  const std::vector<std::string> depths{"1 1 1 1 1 0.5 1 1 1 1 1 1",
                                        "1 1 1 1 1 0.5 1 1 1 1 1 0.95",
                                        "1 1 1 1 0.5 0.5 0.5 1 0.65 0.75 0.85 0.95",
                                        "1 1 1 1 0.5 0.5 0.45 0.5 0.65 0.75 0.85 0.95",
                                        "1 1 1 0.5 0.25 0.35 0.45 0.5 0.65 0.75 0.85 0.95",
                                        "1 1 1 0.5 0.5 0.5 0.45 0.5 0.5 0.75 0.85 0.95",
                                        "1 1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.75 0.85 0.95",
                                        "1 1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.85 0.95",
                                        "1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.95"};
  EXPECT_EQ(t.black_then_grey.depths, depths);
  EXPECT_EQ(t.grey_then_black.depths, depths);
  EXPECT_EQ(t.grey_then_black.colours, t.black_then_grey.colours);
  const std::vector<std::string> colours{
      "W W W W W B W W W W W W", "W W W W W B W W W W W G", "W W W W B B B W G G G G",
      "W W W W B B G B G G G G", "W W W B G G G B G G G G", "W W W B B B G B B G G G",
      "W W B B B B B B B G G G", "W W B B B B B B B B G G", "W B B B B B B B B B B G"};
  EXPECT_EQ(t.black_then_grey.colours, colours);
  // Before the grey one: depth 0.5 where it is black, as the source's rows but for E31.
  const std::vector<std::string> black{
      "W W W W W B W W W W W W", "W W W W W B W W W W W W", "W W W W B B B W W W W W",
      "W W W W B B B B W W W W", "W W W B B B B B W W W W", "W W W B B B B B B W W W",
      "W W B B B B B B B W W W", "W W B B B B B B B B W W", "W B B B B B B B B B B W"};
  EXPECT_EQ(t.black.colours, black);
  for (std::size_t y = 0; y < black.size(); ++y) {
    std::string half;
    for (const char c : black[y]) half += c == 'B' ? "0.5" : c == 'W' ? "1" : " ";
    EXPECT_EQ(t.black.depths[y], half);
  }
}

TEST(Course, DemoCountsAddUp) {
  const Demo d = demo();
  EXPECT_EQ(d.near_fragments + d.far_fragments, d.union_of_both + d.overlap);
  EXPECT_EQ(d.passed_far_first, d.near_fragments + d.far_fragments);
  EXPECT_EQ(d.passed_near_first, d.union_of_both);
  // By both rules, as a program of ten lines counts them. 140 centres lie on the far triangle's two
  // edges that are neither left nor top, none on its left one (areas: 13950 and 16900).
  EXPECT_EQ(d.near_fragments, 13955u);
  EXPECT_EQ(d.far_fragments, 16830u);
  EXPECT_EQ(d.near_closed, 13955u);
  EXPECT_EQ(d.far_closed, 16970u);
}

TEST(Course, MoreSamplesFindMoreOfTheCutPixels) {
  const PartialPixels p = partial_pixels();
  EXPECT_EQ(p.counted[0], 0u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_GT(p.counted[i], p.counted[i - 1]);
    EXPECT_LT(p.mean_error[i], p.mean_error[i - 1]);
  }
  EXPECT_LE(p.counted[3], p.exact);
}

TEST(Course, AffineTextureCoordinatesAreWrongAndPerspectiveOnesAreNot) {
  const Checkerboard affine = checkerboard(pipeline::Interpolation::affine);
  const Checkerboard perspective = checkerboard(pipeline::Interpolation::perspective);
  EXPECT_GT(affine.greatest_error, 0.1);
  // Colours are kept in binary32, the exact weights too; corners are snapped to 2^-16 of a pixel,
  // which far away is a depth of some 10^-3.
  EXPECT_LT(perspective.greatest_error, 2e-3);
}

TEST(Course, SixteenBitsFightAndFartherSurfacesFightMore) {
  EXPECT_LT(fight(0.5, Storage::float32).wrong_share, 0.01);
  EXPECT_GT(fight(10, Storage::unorm16).wrong_share, 0.2);
}

TEST(Course, BallsShowWhatGeometrySays) {
  for (const FacingCount& f : count_facings()) {
    EXPECT_EQ(f.triangles, 2u * 180 * 89);
    // Triangles are of equal area but for the curvature of one of them; the outline passes through
    // some 200 of them.
    const auto n = static_cast<double>(f.triangles);
    EXPECT_NEAR(static_cast<double>(f.front_in_window) / n, f.seen_share, 0.01) << f.distance;
    EXPECT_LE(f.disagreeing, 100u);
    if (f.precision == pipeline::Precision::binary64) {
      EXPECT_EQ(f.disagreeing, 0u);
    }
  }
}

TEST(Course, SharedEdgesAreCoveredOnceAndFlipsExplainTheRest) {
  std::uint64_t turned = 0;
  for (int bits = 0; bits <= 16; bits += 4) {
    const SharedEdges e = count_shared_edges(bits);
    EXPECT_EQ(e.signed_not_one, 0u) << bits;
    EXPECT_EQ(e.unexplained, 0u) << bits;
    turned += e.turned_over;
  }
  EXPECT_GT(turned, 0u);
}

}  // namespace
}  // namespace fathom::studies
