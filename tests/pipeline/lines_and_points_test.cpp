// Lines and points of the scene, drawn by the pipeline: against lines drawn by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fathom/failures/errors.h"
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
  camera.projection.fx = camera.projection.fy = 10;
  camera.projection.cx = camera.projection.cy = 0;
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

PipelineOptions precise_lines() {
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
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise_lines(), true);
  EXPECT_EQ(drawn(frame, 0), expected);
  EXPECT_EQ(frame.statistics.lines, 1U);
}

/// From (5, 15) to a point behind the camera straight to the right: the line leaves the image.
TEST(LinesOfTheScene, AreClippedInClipCoordinates) {
  const Scene scene = scene_of_lines({{5.5, 15.5, 10}, {40, -15.5, -10}}, {{0, 1}});
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise_lines(), false);
  std::vector<Pixel> row;
  for (std::int64_t x = 5; x < 40; ++x) row.push_back({x, 15});
  EXPECT_EQ(drawn(frame, 0), row);
}

/// Along the view 1/w is affine in the window: half way between depths 10 and 30 it is 15.
TEST(LinesOfTheScene, HaveThePerspectiveDepth) {
  const Scene scene = scene_of_lines({{10.5, 4.5, 10}, {90 + 1.5, 13.5, 30}}, {{0, 1}});
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise_lines(), false);
  EXPECT_NEAR(frame.depth[4 * 40 + 10], 10, 1e-5);
  EXPECT_NEAR(frame.depth[4 * 40 + 20], 15, 1e-5);
  EXPECT_NEAR(frame.depth[4 * 40 + 30], 30, 1e-5);
}

/// Half way in the window between red at 10 and blue at 30, in space a quarter of the way.
TEST(LinesOfTheScene, HaveColoursAsTheInterpolationSays) {
  Scene scene = scene_of_lines({{10.5, 4.5, 10}, {90 + 1.5, 13.5, 30}}, {{0, 1}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  PipelineOptions options = precise_lines();
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
  const PipelineFrame frame = render_frame(scene, camera_of_pixels(), precise_lines(), true);
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
  const PipelineRendering r =
      render_by_pipeline(scene, camera_of_pixels(), precise_lines(),
                         {Channel::id, Channel::object, Channel::face}, true);
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

/// The samples of a pixel as multisampling and supersampling have them, from its corner.
std::vector<std::array<double, 2>> sample_places(const Antialias& antialias) {
  std::vector<std::array<double, 2>> places;
  if (antialias.method == AntialiasMethod::msaa)
    return {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
  for (int row = 0; row < antialias.count; ++row)
    for (int column = 0; column < antialias.count; ++column)
      places.push_back({(column + 0.5) / antialias.count, (row + 0.5) / antialias.count});
  return places;
}

/// White by the share of samples in the area of a line or point: a rectangle one pixel wide, a
/// square one pixel large. No sample lies on a border.
void expect_areas(const ColourImage& image, const Antialias& antialias,
                  const std::function<bool(double, double)>& is_inside) {
  const auto places = sample_places(antialias);
  double sum = 0;
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      double share = 0;
      for (const auto& [dx, dy] : places)
        share += is_inside(x + dx, y + dy) / static_cast<double>(places.size());
      ASSERT_NEAR(image.at(x, y)[0], share, 1e-7) << x << " " << y;
      sum += share;
    }
  EXPECT_GT(sum, 0.5);
}

TEST(LinesOfTheScene, AreAntialiasedAsRectangles) {
  const Scene line = scene_of_lines({{2.53, 3.51, 10}, {37.57, 17.49, 10}}, {{0, 1}});
  const Scene point = scene_of_lines({{3.33, 20.71, 10}}, {}, {0});
  PipelineOptions options = precise_lines();
  const PipelineFrame plain = render_frame(line, camera_of_pixels(), options, true);
  const auto in_rectangle = [](double x, double y) {
    const double dx = 37.57 - 2.53, dy = 17.49 - 3.51, length = std::hypot(dx, dy);
    const double along = ((x - 2.53) * dx + (y - 3.51) * dy) / length;
    const double aside = ((x - 2.53) * dy - (y - 3.51) * dx) / length;
    return 0 <= along && along < length && std::abs(aside) < 0.5;
  };
  const auto in_square = [](double x, double y) {
    return std::abs(x - 3.33) < 0.5 && std::abs(y - 20.71) < 0.5;
  };
  for (const Antialias& antialias :
       {Antialias{AntialiasMethod::ssaa, 4}, {AntialiasMethod::msaa, 4}}) {
    options.antialias = antialias;
    const PipelineFrame frame = render_frame(line, camera_of_pixels(), options, true);
    expect_areas(frame.picture, antialias, in_rectangle);
    EXPECT_EQ(frame.id, plain.id);  // the map is that of whole pixels
    expect_areas(render_frame(point, camera_of_pixels(), options, true).picture, antialias,
                 in_square);
  }
  // Every method comes near to the area: 37.7 pixels of length, one wide.
  for (const Antialias& antialias : {Antialias{AntialiasMethod::ssaa, 16},
                                     {AntialiasMethod::msaa, 16},
                                     {AntialiasMethod::jitter, 64},
                                     {AntialiasMethod::taa, 64}}) {
    options.antialias = antialias;
    double sum = 0;
    for (const Colour& c : render_frame(line, camera_of_pixels(), options, true).picture.pixels)
      sum += c[0];
    EXPECT_NEAR(sum, std::hypot(37.57 - 2.53, 17.49 - 3.51), 0.5);
  }
}

/// The edges of a triangle and its corners, antialiased: half-covered pixels, which a line of whole
/// pixels never has.
TEST(Outlines, AreAntialiased) {
  Scene scene = scene_of_lines({{3.2, 4.1, 10}, {35.7, 8.3, 10}, {12.4, 26.9, 10}}, {});
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].face_count = 1;
  for (const Shading shading : {Shading::wireframe, Shading::points}) {
    PipelineOptions options = precise_lines();
    options.shading = shading;
    const auto partial = [&](const Antialias& antialias) {
      options.antialias = antialias;
      const ColourImage image = render_frame(scene, camera_of_pixels(), options, true).picture;
      return std::ranges::count_if(image.pixels,
                                   [](const Colour& c) { return c[0] > 0.01 && c[0] < 0.99; });
    };
    EXPECT_EQ(partial({AntialiasMethod::none, 1}), 0);
    EXPECT_GT(partial({AntialiasMethod::msaa, 8}), shading == Shading::points ? 2 : 20);
  }
}

TEST(LinesOfTheScene, AreRefusedWhereOnlyAreasAreDrawn) {
  const Scene scene = scene_of_lines({{2, 3, 10}, {3, 17, 10}}, {{0, 1}});
  PipelineOptions painter = precise_lines(), area = precise_lines();
  painter.hidden_surface = HiddenSurface::painter;
  area.antialias.method = AntialiasMethod::area;
  for (const PipelineOptions& options : {painter, area})
    EXPECT_THROW(render_frame(scene, camera_of_pixels(), options, true), UsageError);
}

}  // namespace
}  // namespace fathom::pipeline
