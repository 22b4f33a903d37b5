#include "validation/studies/course/demo.h"

#include <algorithm>
#include <array>

#include "fathom/image/depth_map.h"
#include "fathom/pipeline/render_pipeline.h"
#include "validation/studies/cell.h"
#include "validation/studies/pipeline_scenes.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

Scene demo_scene(bool far_first) {
  Scene scene = scene_of({{80, 30, 0.3},
                          {30, 200, 0.3},
                          {200, 180, 0.3},
                          {160, 20, 0.6},
                          {100, 220, 0.6},
                          {290, 150, 0.6}},
                         far_first ? std::vector<CornerIndices>{{3, 4, 5}, {0, 1, 2}}
                                   : std::vector<CornerIndices>{{0, 1, 2}, {3, 4, 5}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1},
                             {1, 1, 0, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}};
  return scene;
}

}  // namespace

Demo demo() {
  const Camera camera = window_camera(320, 240);
  PipelineOptions options = precise_options();
  options.background = {0.05, 0.05, 0.1};
  const PipelineFrame far_first = render_frame(demo_scene(true), camera, options, true);
  const PipelineFrame near_first = render_frame(demo_scene(false), camera, options, true);
  Demo result{pipeline::to_rgb(far_first.picture)};
  const auto fragments = [&](CornerIndices triangle) {
    Scene scene = demo_scene(true);
    scene.meshes[0].triangles = {triangle};
    return render_frame(scene, camera, options, false).statistics.fragments;
  };
  result.near_fragments = fragments({0, 1, 2});
  result.far_fragments = fragments({3, 4, 5});
  result.union_of_both = static_cast<std::uint64_t>(std::count_if(
      far_first.id.begin(), far_first.id.end(), [](auto id) { return id != no_surface; }));
  result.overlap = result.near_fragments + result.far_fragments - result.union_of_both;
  result.passed_far_first = far_first.statistics.depth_passed;
  result.passed_near_first = near_first.statistics.depth_passed;
  return result;
}

Tables z_buffer_tables() {
  constexpr int columns = 12, rows = 9;
  // Columns of the black triangle and of the grey one, first and last, as in the source.
  constexpr std::array<std::array<int, 2>, rows> black{
      {{5, 5}, {5, 5}, {4, 6}, {4, 7}, {3, 7}, {3, 8}, {2, 8}, {2, 9}, {1, 10}}};
  constexpr std::array<int, rows> grey{12, 11, 8, 6, 4, 6, 8, 9, 11};
  Tables tables;
  for (int y = 0; y < rows; ++y) {
    std::array<double, columns> depth;
    std::array<char, columns> colour;
    for (int x = 0; x < columns; ++x) {
      const bool covered = black[y][0] <= x && x <= black[y][1];
      depth[x] = covered ? 0.5 : 1;
      colour[x] = covered ? 'B' : 'W';
    }
    const auto write = [&](std::vector<std::string>& depths, std::vector<std::string>& colours) {
      std::string d, c;
      for (int x = 0; x < columns; ++x) {
        d += (x ? " " : "") + text_of(depth[x], ".3g");
        c += (x ? " " : "") + std::string(1, colour[x]);
      }
      depths.push_back(d);
      colours.push_back(c);
    };
    write(tables.depth_before, tables.colour_before);
    for (int x = grey[y]; x < columns; ++x) {
      const double z = (25 + 10 * (x - 4)) / 100.0;  // nearer on the left
      if (!(z < depth[x])) continue;
      depth[x] = z;
      colour[x] = 'G';
    }
    write(tables.depth_after, tables.colour_after);
  }
  return tables;
}

}  // namespace fathom::studies
