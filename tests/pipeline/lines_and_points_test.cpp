// Lines and points of the scene, drawn by the pipeline: against lines drawn by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/numeric/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/render_by_pipeline.h"
#include "tests/pipeline/layers.h"

namespace fathom::pipeline {
namespace {

using testing::Each;

/// 40 × 30 pixels; a point (x, y, 10) of the world is the place (x, y) of the image.
Camera camera_of_pixels() {
  Camera camera;
  camera.width = 40;
  camera.height = 30;
  camera.fx = camera.fy = 10;
  camera.cx = camera.cy = 0;
  camera.near = 1;
  camera.far = 100;
  return camera;
}

Scene scene_of_lines(const std::vector<MeshPoint>& vertices,
                     const std::vector<std::array<std::uint32_t, 2>>& lines,
                     const std::vector<std::uint32_t>& points = {}) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].vertices = vertices;
  scene.meshes[0].lines = lines;
  scene.meshes[0].points = points;
  scene.objects.resize(1);
  return scene;
}

PipelineOptions precise() {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::float64;
  return options;
}

std::vector<Pixel> drawn(const PipelineFrame& frame, std::uint32_t id) {
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < frame.id.size(); ++i)
    if (frame.id[i] == id)
      pixels.push_back({static_cast<std::int64_t>(i % 40), static_cast<std::int64_t>(i / 40)});
  std::ranges::sort(pixels);
  return pixels;
}

TEST(LinesOfTheScene, AreThePixelsOfTheirAlgorithm) {
  const Scene scene = scene_of_lines({{2.5, 3.5, 10}, {37.5, 17.5, 10}}, {{0, 1}});
  std::vector<Pixel> expected;
  bresenham_line({2, 3, 37, 17}, {0, 0, 40, 30},
                 [&](const Pixel& p, const auto&) { expected.push_back(p); });
  std::ranges::sort(expected);
  ASSERT_EQ(expected.size(), 36U);
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise(), true);
  EXPECT_EQ(drawn(frame, 0), expected);
  EXPECT_EQ(frame.statistics.lines, 1U);
}

/// From (5, 15) to a point behind the camera straight to the right: the line leaves the image.
TEST(LinesOfTheScene, AreClippedInClipCoordinates) {
  const Scene scene = scene_of_lines({{5.5, 15.5, 10}, {40, -15.5, -10}}, {{0, 1}});
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise(), false);
  std::vector<Pixel> row;
  for (std::int64_t x = 5; x < 40; ++x) row.push_back({x, 15});
  EXPECT_EQ(drawn(frame, 0), row);
}

/// Along the view 1/w is affine in the window: half way between depths 10 and 30 it is 15.
TEST(LinesOfTheScene, HaveThePerspectiveDepth) {
  const Scene scene = scene_of_lines({{10.5, 4.5, 10}, {90 + 1.5, 13.5, 30}}, {{0, 1}});
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise(), false);
  EXPECT_NEAR(frame.depth[4 * 40 + 10], 10, 1e-5);
  EXPECT_NEAR(frame.depth[4 * 40 + 20], 15, 1e-5);
  EXPECT_NEAR(frame.depth[4 * 40 + 30], 30, 1e-5);
}

/// Half way in the window between red at 10 and blue at 30, in space a quarter of the way.
TEST(LinesOfTheScene, HaveColoursAsTheInterpolationSays) {
  Scene scene = scene_of_lines({{10.5, 4.5, 10}, {90 + 1.5, 13.5, 30}}, {{0, 1}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  PipelineOptions options = precise();
  for (const auto& [interpolation, blue] :
       {std::pair{Interpolation::perspective, 0.25}, {Interpolation::affine, 0.5}}) {
    options.interpolation = interpolation;
    const PipelineFrame frame = render_frame(scene, camera_of_pixels(), options, true);
    EXPECT_NEAR(frame.picture.at(20, 4)[2], blue, 0x1p-24);
    EXPECT_NEAR(frame.picture.at(20, 4)[0], 1 - blue, 0x1p-24);
    EXPECT_NEAR(frame.depth[4 * 40 + 20], 15, 1e-5);
  }
}

TEST(PointsOfTheScene, FillTheirPixelAndAreClipped) {
  const Scene scene =
      scene_of_lines({{7.9, 8.1, 10}, {39.9, 29.9, 10}, {41, 5, 10}, {5, 5, 200}, {-7, -8, -10}},
                     {}, {0, 1, 2, 3, 4});
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise(), true);
  EXPECT_EQ(drawn(frame, 0), (std::vector<Pixel>{{7, 8}}));
  EXPECT_EQ(drawn(frame, 1), (std::vector<Pixel>{{39, 29}}));
  EXPECT_EQ(frame.statistics.points, 2U);
  EXPECT_EQ(std::ranges::count(frame.id, no_surface), 40 * 30 - 2);
}

/// A wall at depth 10, a line in front of it, one behind, and a point: the depth test decides, the
/// numbers go on after the wall's triangles, and channels name the object.
TEST(LinesOfTheScene, AreHiddenByTrianglesAndNumberedAfterThem) {
  Scene scene = layers({{10, {}, {0, 0, 1}}});
  scene.meshes.push_back(
      scene_of_lines({{4.5, 5.5, 9}, {20.5, 5.5, 9}, {4.5, 9.5, 11}, {20.5, 9.5, 11}, {8, 12, 5}},
                     {{0, 1}, {2, 3}}, {4})
          .meshes[0]);
  scene.objects.push_back({});
  scene.objects[1].mesh = 1;
  scene.draw_states.clear();
  const PipelineRendering r = render_by_pipeline(
      scene, camera_of_pixels(), precise(), {Channel::id, Channel::object, Channel::face}, true);
  const auto& id = *r.map.values<std::uint32_t>("id");
  const auto& object = *r.map.values<std::uint32_t>("object");
  const auto& face = *r.map.values<std::uint32_t>("face");
  EXPECT_EQ(std::ranges::count(id, 2U), 18);  // x from 5 to 22, row 6: 45/9 … 205/9
  EXPECT_EQ(std::ranges::count(id, 3U), 0);
  EXPECT_EQ(std::ranges::count(id, 4U), 1);
  for (std::size_t i = 0; i < id.size(); ++i) {
    EXPECT_EQ(object[i], id[i] < 2 ? 0U : 1U);
    EXPECT_EQ(face[i], id[i] < 2 ? 0U : no_surface);
    EXPECT_EQ(r.picture.pixels[i], id[i] < 2 ? r.picture.pixels[0] : (Rgb{255, 255, 255}));
  }
}

/// Lines and points fill whole pixels: every sample, whatever the antialiasing.
TEST(LinesOfTheScene, AreNotAntialiased) {
  const Scene scene =
      scene_of_lines({{2.5, 3.5, 10}, {37.5, 17.5, 10}, {3, 20, 10}}, {{0, 1}}, {2});
  PipelineOptions options = precise();
  const ColourImage plain = render_frame(scene, camera_of_pixels(), options, true).picture;
  for (const Antialias& antialias : {Antialias{AntialiasMethod::ssaa, 3},
                                     {AntialiasMethod::msaa, 4},
                                     {AntialiasMethod::jitter, 4},
                                     {AntialiasMethod::taa, 3}}) {
    options.antialias = antialias;
    const ColourImage image = render_frame(scene, camera_of_pixels(), options, true).picture;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      EXPECT_NEAR(image.pixels[i][0], plain.pixels[i][0], 1e-12) << i;
  }
}

TEST(LinesOfTheScene, AreRefusedWhereOnlyAreasAreDrawn) {
  const Scene scene = scene_of_lines({{2, 3, 10}, {3, 17, 10}}, {{0, 1}});
  PipelineOptions painter = precise(), area = precise();
  painter.hidden_surface = HiddenSurface::painter;
  area.antialias.method = AntialiasMethod::area;
  for (const PipelineOptions& options : {painter, area})
    EXPECT_THROW(render_frame(scene, camera_of_pixels(), options, true), UsageError);
}

}  // namespace
}  // namespace fathom::pipeline
