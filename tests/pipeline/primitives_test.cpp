// Points and lines as primitives, and the three tests for which side of a triangle is seen.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "fathom/pipeline/geometry/primitive_assembly.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/render_pipeline.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

using fathom::checks::scene_of;

/// 32 × 32 pixels; (x, y, 2) lies at 16 + 16·x, 16 + 16·y.
Camera camera_of_primitives() {
  Camera camera;
  camera.width = camera.height = 32;
  camera.projection.fx = camera.projection.fy = 32;
  camera.projection.cx = camera.projection.cy = 16;
  camera.near = 1;
  camera.far = 100;
  return camera;
}

PipelineOptions drawing(Shading shading) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = shading;
  return options;
}

std::set<Pixel> drawn(const PipelineFrame& frame) {
  std::set<Pixel> pixels;
  for (std::int64_t y = 0; y < 32; ++y)
    for (std::int64_t x = 0; x < 32; ++x)
      if (frame.id[static_cast<std::size_t>(y * 32 + x)] != no_surface) pixels.insert({x, y});
  return pixels;
}

/// A file may have normals for some of its corners only, or name some that it does not have.
TEST(PrimitiveAssembly, CornersWithoutANormalGetTheirVertexs) {
  Scene scene = scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].normals = {{0, 1, 0}};
  scene.meshes[0].normal_triangles = {{0, no_index, 0}, {no_index, 0, no_index}};
  const std::vector<InputTriangle> triangles =
      assemble_triangles(scene, 0, 0, FrontFace::counter_clockwise);
  using Normal = std::array<double, 3>;
  EXPECT_EQ(triangles[0].corners[0].normal, (Normal{0, 1, 0}));
  EXPECT_EQ(triangles[0].corners[1].normal, (Normal{0, 0, 1}));
  EXPECT_EQ(triangles[1].corners[0].normal, (Normal{1 / std::sqrt(2), 0, 1 / std::sqrt(2)}));
  EXPECT_EQ(triangles[1].corners[1].normal, (Normal{0, 1, 0}));
  EXPECT_EQ(triangles[1].corners[2].normal, (Normal{1, 0, 0}));
}

TEST(PrimitiveAssembly, JoinsByOnesTwosAndThrees) {
  const std::vector<std::uint32_t> indices{4, 1, 0, 2, 3, 7, 5};
  EXPECT_EQ(assemble<1>(indices).size(), 7u);
  EXPECT_EQ(assemble<2>(indices),
            (std::vector<std::array<std::uint32_t, 2>>{{4, 1}, {0, 2}, {3, 7}}));
  EXPECT_EQ(assemble<3>(indices),
            (std::vector<std::array<std::uint32_t, 3>>{{4, 1, 0}, {2, 3, 7}}));
}

TEST(Primitives, PointsAreThePixelsOfTheCorners) {
  const Scene scene = scene_of({{-0.5, -0.5, 2}, {0.25, 0, 2}, {0, 0.75, 2}}, {{0, 1, 2}});
  EXPECT_EQ(drawn(render_frame(scene, camera_of_primitives(), drawing(Shading::points), true)),
            (std::set<Pixel>{{8, 8}, {20, 16}, {16, 28}}));
}

TEST(Primitives, PointsOutsideAreClipped) {
  const Scene scene = scene_of({{-0.5, -0.5, 2}, {9, 0, 2}, {0, 0, -2}}, {{0, 1, 2}});
  EXPECT_EQ(drawn(render_frame(scene, camera_of_primitives(), drawing(Shading::points), true)),
            (std::set<Pixel>{{8, 8}}));
}

TEST(Primitives, LinesAreClippedAsLines) {
  // One corner far to the right: the triangle is cut to a quadrangle by the image's side. Its
  // outline is two lines to that side; neither the side nor a diagonal of the quadrangle is drawn.
  const Scene scene = scene_of({{-0.875, 0, 2}, {3, -2, 2}, {3, 2, 2}}, {{0, 1, 2}});
  const auto pixels =
      drawn(render_frame(scene, camera_of_primitives(), drawing(Shading::wireframe), true));
  for (const Pixel& p : pixels) {
    // The exact lines: |v − 16| = (u − 2)·32/62. Ends on pixels, then a rounding of the line: each
    // moves it by at most a pixel.
    const double v = std::abs(static_cast<double>(p.y) + 0.5 - 16);
    EXPECT_NEAR(v, (static_cast<double>(p.x) + 0.5 - 2) * 32 / 62, 1.5) << p.x << " " << p.y;
  }
  EXPECT_GE(pixels.size(), 55u);
}

TEST(Primitives, LinesThroughThePlaneOfTheEyeAreCutAtNear) {
  // From (−0.5, −0.25, 2) to a corner behind the eye: the line leaves the image, and does not come
  // back on the other side, where the corner behind the eye would project to.
  const Scene scene =
      scene_of({{-0.5, -0.25, 2}, {-0.5, -0.25, -6}, {-0.25, -0.25, 2}}, {{0, 1, 2}});
  const auto pixels =
      drawn(render_frame(scene, camera_of_primitives(), drawing(Shading::wireframe), true));
  EXPECT_GT(pixels.size(), 8u);
  for (const Pixel& p : pixels) {
    EXPECT_LT(p.x, 16);
    EXPECT_LT(p.y, 16);
  }
}

TEST(Triangle, OfAHundredAndOfEighteenPixels) {
  // Halves of rectangles of 20 by 10 and 9 by 4 pixels, whose diagonals pass through no centre:
  // 9(2j + 1) is odd and 4(2i + 1) is not.
  const auto fragments = [](double width, double height) {
    const auto t = GridTriangle::of({snap(0, 0, 8), snap(width, 0, 8), snap(width, height, 8)});
    int count = 0;
    for (std::int64_t y = -1; y <= 10; ++y)
      for (std::int64_t x = -1; x <= 20; ++x) count += t->covers(sample_of({x, y}));
    return count;
  };
  EXPECT_EQ(fragments(20, 10), 100);
  EXPECT_EQ(fragments(9, 4), 18);
}

TEST(Strips, ManySamplesGiveTheSamePictureAsTheWholeAtOnce) {
  // Four rows of 4096 pixels of 256 samples are a strip; five rows of 64 pixels fit into one.
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> side(-1, 1);
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) v.push_back({side(random), side(random) / 300, 2 + side(random)});
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Camera wide = camera_of_primitives();
  wide.width = 4096;
  wide.height = 5;
  wide.projection.fx = wide.projection.fy = 4096;
  wide.projection.cx = 2048;
  wide.projection.cy = 2.5;
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.antialias = {AntialiasMethod::ssaa, 16};
  const PipelineFrame strips = render_frame(scene_of(v, t), wide, options, true);
  Camera narrow = wide;
  narrow.width = 64;
  narrow.projection.cx = 2048 - 1000;
  const PipelineFrame whole = render_frame(scene_of(v, t), narrow, options, true);
  // Triangles are clipped at the sides of the narrow image, and the new corners snapped: an edge
  // moves by less than 1/256 of a pixel, past a few of 256 samples. A row that is missed or taken
  // twice would show as a difference of half a pixel.
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(whole.picture.at(x, y)[k], strips.picture.at(1000 + x, y)[k], 16.0 / 256)
            << x << " " << y;
}

TEST(Facings, TheThreeTestsAgreeButWhereTrianglesAreEdgeOn) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> side(-0.9, 0.9);
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (int k = 0; k < 3; ++k) v.push_back({side(random), side(random), 3 + side(random)});
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto facings = [&](Precision precision) {
    PipelineOptions options = drawing(Shading::none);
    options.precision = precision;
    return render_frame(scene_of(v, t), camera_of_primitives(), options, false).statistics.facings;
  };
  const FacingStatistics f = facings(Precision::binary64);
  EXPECT_EQ(f.compared, 300u);
  EXPECT_EQ(f.disagreeing, 0u);
  EXPECT_EQ(f.front_in_world, f.front_in_window);
  EXPECT_GT(f.front_in_world, 100u);
  EXPECT_LT(f.front_in_world, 200u);
  // All triangles edge on but for 10⁻⁸ of their size: binary32 cannot tell.
  for (std::uint32_t i = 0; i < 300; ++i) {
    const MeshPoint &a = v[3 * i], &b = v[3 * i + 1];
    const double s = 0.3 + 0.001 * i;
    v[3 * i + 2] = {(a.x + s * (b.x - a.x)) * 1.1, (a.y + s * (b.y - a.y)) * 1.1,
                    (a.z + s * (b.z - a.z)) * 1.1 + (i % 2 ? 1e-8 : -1e-8)};
  }
  EXPECT_GT(facings(Precision::binary32).disagreeing, 20u);
  EXPECT_LE(facings(Precision::binary32).disagreeing, 300u);
  // As many as two of them differ by, at least.
  const FacingStatistics g = facings(Precision::binary32);
  const auto difference = [](std::uint64_t a, std::uint64_t b) { return a < b ? b - a : a - b; };
  EXPECT_GE(g.disagreeing, difference(g.front_in_world, g.front_in_window));
  EXPECT_GE(g.disagreeing, difference(g.front_in_ndc, g.front_in_window));
}

}  // namespace
}  // namespace fathom::pipeline
