#include "apps/study/course/demo.h"

#include <algorithm>
#include <array>
#include <bit>

#include "apps/study/cell.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

/// The far one first.
Scene demo_scene() {
  Scene scene = scene_of({{80, 30, 0.3},
                          {30, 200, 0.3},
                          {200, 180, 0.3},
                          {160, 20, 0.6},
                          {100, 220, 0.6},
                          {290, 150, 0.6}},
                         {{3, 4, 5}, {0, 1, 2}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1},
                             {1, 1, 0, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}};
  return scene;
}

/// Whether each centre of a pixel is inside a triangle or on its outline, by the signs of three
/// integers.
std::vector<bool> closed_pixels(const std::array<std::array<std::int64_t, 2>, 3>& corners) {
  std::vector<bool> pixels;
  for (std::int64_t y = 1; y < 2 * 240; y += 2) {
    for (std::int64_t x = 1; x < 2 * 320; x += 2) {
      bool left = true, right = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % 3];
        const std::int64_t side = (b[0] - a[0]) * (y - 2 * a[1]) - (b[1] - a[1]) * (x - 2 * a[0]);
        left &= side >= 0;
        right &= side <= 0;
      }
      pixels.push_back(left || right);
    }
  }
  return pixels;
}

std::uint64_t count_of(const std::vector<bool>& pixels) {
  return static_cast<std::uint64_t>(std::count(pixels.begin(), pixels.end(), true));
}

constexpr std::uint32_t table_columns = 12, table_rows = 9;
constexpr double table_near = 0.125;

/// The two triangles of the tables, drawn in an order: 0 is black, at window depth 0.5; 1 is grey,
/// from 0.25 at column 4 to 0.95 at column 11. Their sides are straight lines between those centres
/// that the source's tables have inside and those that they have outside:
///   black   x = 5.4 − k/2 and x = 5.8 + 3k/5 at the centres of row k
///   grey    x = 12.8 − 11k/5 and x = 8k/5 − 2, up to the right side of the window
Scene black_and_grey(const std::vector<std::uint32_t>& order) {
  const auto at = [](double x, double k, double window_z) {
    return MeshPoint{x, k + 0.5, window_z + table_near};
  };
  const auto grey = [&](double x, double k) { return at(x, k, 0.25 + 0.1 * (x - 4.5)); };
  // Where the two sides of each meet, and where they are cut off.
  const double black_top = -4.0 / 11, grey_left = 74.0 / 19;
  const Scene all = scene_of({at(5.4 - black_top / 2, black_top, 0.5), at(5.8 + 0.6 * 20, 20, 0.5),
                              at(5.4 - 0.5 * 20, 20, 0.5), grey(12.8 - 2.2 * grey_left, grey_left),
                              grey(12, 4.0 / 11), grey(12, 8.75)},
                             {{0, 1, 2}, {3, 4, 5}});
  Scene scene = all;
  scene.meshes[0].triangles.clear();
  for (const std::uint32_t i : order)
    scene.meshes[0].triangles.push_back(all.meshes[0].triangles[i]);
  scene.meshes[0].face_count = order.size();
  const std::array<float, 4> black{0, 0, 0, 1}, grey_colour{0.5F, 0.5F, 0.5F, 1};
  scene.meshes[0].colours = {black, black, black, grey_colour, grey_colour, grey_colour};
  return scene;
}

/// How the window depths become those of the tables.
Camera table_camera() {
  Camera camera = window_camera(table_columns, table_rows);
  camera.near = table_near;
  camera.far = table_near + 1;
  return camera;
}

PipelineOptions table_options() {
  PipelineOptions options = precise_options();
  options.background = {1, 1, 1};
  return options;
}

PipelineOptions demo_options() {
  PipelineOptions options = precise_options();
  options.background = {0.05, 0.05, 0.1};
  return options;
}

/// What the depth buffer and the colour buffer hold when the scene is drawn.
BufferContents contents_of(const Scene& scene) {
  const PipelineFrame frame = render_frame(scene, table_camera(), table_options(), true);
  BufferContents contents;
  for (std::size_t first = 0; first < frame.stored.size(); first += table_columns) {
    std::string depths, colours;
    for (std::size_t i = first; i < first + table_columns; ++i) {
      const std::string space = i == first ? "" : " ";
      const auto stored = std::bit_cast<float>(static_cast<std::uint32_t>(frame.stored[i].bits));
      depths += space + text_of(static_cast<double>(stored), ".3g");
      const double white = frame.picture.pixels[i][0];
      colours += space + (white > 0.75 ? "W" : white > 0.25 ? "G" : "B");
    }
    contents.depths.push_back(depths);
    contents.colours.push_back(colours);
  }
  return contents;
}

}  // namespace

SceneFiles demo_files() {
  return scene_files("demo", demo_scene(), window_camera(320, 240));
}

Demo demo() {
  const SceneView view = demo_files().view;
  PipelineOptions options = demo_options();
  const PipelineFrame far_first = render_frame(view.scene, view.camera, options, true);
  Demo result{pipeline::to_rgb(far_first.picture)};
  const auto fragments = [&](std::size_t triangle) {
    Scene scene = view.scene;
    scene.meshes[0].triangles = {view.scene.meshes[0].triangles[triangle]};
    return render_frame(scene, view.camera, options, false).statistics.fragments;
  };
  result.near_fragments = fragments(1);
  result.far_fragments = fragments(0);
  std::vector<bool> near_pixels = closed_pixels({{{80, 30}, {30, 200}, {200, 180}}});
  const std::vector<bool> far_pixels = closed_pixels({{{160, 20}, {100, 220}, {290, 150}}});
  result.near_closed = count_of(near_pixels);
  result.far_closed = count_of(far_pixels);
  for (std::size_t i = 0; i < near_pixels.size(); ++i)
    near_pixels[i] = near_pixels[i] || far_pixels[i];
  result.union_closed = count_of(near_pixels);
  result.union_of_both = static_cast<std::uint64_t>(std::count_if(
      far_first.id.begin(), far_first.id.end(), [](auto id) { return id != no_surface; }));
  result.overlap = result.near_fragments + result.far_fragments - result.union_of_both;
  result.passed_far_first = far_first.statistics.depth_passed;
  options.draw_order = pipeline::DrawOrder::front_to_back;
  result.passed_near_first =
      render_frame(view.scene, view.camera, options, false).statistics.depth_passed;
  return result;
}

Tables z_buffer_tables() {
  return {contents_of(black_and_grey({0})), contents_of(black_and_grey({0, 1})),
          contents_of(black_and_grey({1, 0}))};
}

SceneFiles z_buffer_files() {
  return scene_files("z-buffer", black_and_grey({0, 1}), table_camera());
}

RgbImage z_buffer_picture() {
  return pipeline_picture(z_buffer_files().view, table_options());
}

}  // namespace fathom::studies
