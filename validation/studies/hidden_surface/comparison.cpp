#include "validation/studies/hidden_surface/comparison.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "fathom/render.h"
#include "validation/studies/hidden_surface/bsp_tree.h"
#include "validation/studies/hidden_surface/warnock.h"
#include "validation/studies/pipeline_scenes.h"

namespace fathom::studies {
namespace {

using pipeline::HiddenSurface;
using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

Scene pair(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d, MeshPoint e, MeshPoint f) {
  return scene_of({a, b, c, d, e, f}, {{0, 1, 2}, {3, 4, 5}});
}

std::vector<std::uint32_t> exact_ids(const Scene& scene, const Camera& camera) {
  RenderOptions options;
  options.channels = {Channel::id};
  const DepthMap map = render(scene, camera, options);
  const auto& ids = *map.values<std::uint32_t>("id");
  return {ids.begin(), ids.end()};
}

template <class Ids>
std::size_t different(const std::vector<std::uint32_t>& exact, const Ids& ids) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) count += exact[i] != ids[i];
  return count;
}

PipelineOptions z_buffer_options(Storage storage) {
  PipelineOptions options = precise_options();
  options.depth_format.storage = storage;
  return options;
}

HiddenSurfaceCase compare(const HiddenSurfaceScene& c) {
  HiddenSurfaceCase result{c.name};
  Scene coloured = c.scene;
  paint_each_triangle(coloured);
  SceneFiles drawn = scene_files(c.name, coloured, hidden_surface_camera());
  const Scene& painted = drawn.view.scene;
  const Camera& camera = drawn.view.camera;
  const auto exact = exact_ids(c.scene, camera);
  for (const std::uint32_t id : exact) result.seen += id != no_surface;
  PipelineOptions options = z_buffer_options(Storage::float32);
  result.buffer32 = different(exact, render_frame(painted, camera, options, false).id);
  options = z_buffer_options(Storage::unorm16);
  result.buffer16 = different(exact, render_frame(painted, camera, options, false).id);
  options.hidden_surface = HiddenSurface::painter;
  const PipelineFrame frame = render_frame(painted, camera, options, true);
  result.painter = different(exact, frame.id);
  result.order = frame.painter;
  result.picture = pipeline::to_rgb(frame.picture);
  result.warnock = different(exact, warnock(c.scene, camera).ids);
  result.bsp_tree = different(exact, bsp_tree(c.scene, camera).ids);
  result.files = std::move(drawn.files);
  return result;
}

/// The least time of a few runs in milliseconds, and what the last of them gave.
template <class Run>
auto timed(const Run& run) {
  using Clock = std::chrono::steady_clock;
  std::pair<double, decltype(run())> result{std::numeric_limits<double>::infinity(), {}};
  for (int frame = 0; frame < 5; ++frame) {
    const Clock::time_point start = Clock::now();
    result.second = run();
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    result.first = std::min(result.first, time.count());
  }
  return result;
}

}  // namespace

std::vector<HiddenSurfaceScene> hidden_surface_scenes() {
  return {{"z-disjoint",
           pair({-1, -1, 4}, {1, -1, 4}, {0, 1, 4}, {-1.8, -0.9, 6}, {2.2, -0.9, 6}, {0.2, 2, 6})},
          {"nearer-zmin",
           pair({-1, -1, 4}, {1, -1, 5}, {0, 1, 5}, {-1, -0.6, 4.5}, {1, -0.6, 6}, {0, 1.2, 6})},
          {"farther-zmin", pair({-1, -1, 4}, {1, -1, 6}, {0.8, 1, 7}, {-1, -0.5, 4.6},
                                {0.3, -0.6, 5.9}, {-0.2, 0.5, 6})},
          {"x-disjoint", pair({-1.2, -1, 4}, {-0.1, -1, 6}, {-0.5, 1, 5}, {0.1, -1, 5},
                              {1.2, -1, 4}, {0.5, 1, 6})},
          {"y-disjoint", pair({-1, -1.2, 4}, {-1, -0.1, 6}, {1, -0.5, 5}, {-1, 0.1, 5},
                              {-1, 1.2, 4}, {1, 0.5, 6})},
          {"equal-zmax",
           pair({-1, -1, 4}, {1, -1, 6}, {0, 1, 5}, {-1, -0.6, 4.5}, {1, -0.6, 6}, {0, 1.2, 5.5})},
          // Each passes through the plane of the other, beside it: no test of planes settles it.
          {"splitting", pair({-1.5, -1, 5}, {1.5, -1, 5}, {0, 1.5, 5}, {0.3, -0.8, 4.36},
                             {2.5, -0.4, 4.68}, {2.2, 0.8, 5.64})},
          {"cycle", cyclic_overlap()},
          {"penetration", penetration()}};
}

Camera hidden_surface_camera() {
  Camera camera = front_camera(160, 160, 1, 20);
  camera.cx += 0.1234567;
  camera.cy += 0.7654321;
  return camera;
}

std::vector<HiddenSurfaceCase> compare_hidden_surfaces() {
  std::vector<HiddenSurfaceCase> results;
  for (const HiddenSurfaceScene& c : hidden_surface_scenes()) results.push_back(compare(c));
  return results;
}

HiddenSurfaceCost hidden_surface_cost(std::uint32_t triangles) {
  const Camera camera = front_camera(320, 240, 1, 20);
  const Scene scene = random_triangles(triangles, 9);
  PipelineOptions options = z_buffer_options(Storage::float32);
  const auto draw = [&] { return render_frame(scene, camera, options, false); };
  const double buffer_ms = timed(draw).first;
  options.hidden_surface = HiddenSurface::painter;
  const auto [painter_ms, frame] = timed(draw);
  const auto [warnock_ms, windows] = timed([&] { return warnock(scene, camera); });
  const auto [bsp_tree_ms, pieces] = timed([&] { return bsp_tree(scene, camera); });
  const std::uint64_t polygons = triangles + frame.painter.splits;
  return {triangles,
          buffer_ms,
          painter_ms,
          warnock_ms,
          bsp_tree_ms,
          std::uint64_t{camera.width} * camera.height * sizeof(float),
          polygons * sizeof(pipeline::WindowTriangle<double>),
          frame.painter.comparisons,
          frame.painter.splits,
          windows.steps,
          pieces.polygons};
}

}  // namespace fathom::studies
