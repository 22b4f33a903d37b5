#include "apps/study/hidden_surface/comparison.h"

#include <utility>

#include "apps/study/hidden_surface/sight.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/render.h"

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
  const DepthMap map = render(scene, camera, options).map;
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

/// A frame by one algorithm, timed and, once more, weighed; and what it gave.
template <class Run>
auto cost_of(const Run& run) {
  auto [ms, result] = least_time(run);
  return std::pair(FrameCost{ms, peak_bytes([&] { run(); })}, std::move(result));
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
  camera.projection.cx += 0.1234567;
  camera.projection.cy += 0.7654321;
  return camera;
}

HiddenSurfaceCase compare_hidden_surfaces(const std::string& name, const Scene& scene,
                                          const Camera& camera) {
  HiddenSurfaceCase result{name};
  Scene coloured = scene;
  paint_each_triangle(coloured);
  SceneFiles drawn = scene_files(name, coloured, camera);
  const Scene& painted = drawn.view.scene;
  const auto exact = exact_ids(scene, camera);
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
  result.warnock = different(exact, warnock(scene, camera).ids);
  const auto tree_errors = [&](TreeArithmetic arithmetic) {
    const Sight sight = bsp_tree(scene, camera, arithmetic);
    return TreeErrors{different(exact, sight.ids), sight.polygons};
  };
  result.bsp_tree = tree_errors(TreeArithmetic::binary64);
  result.bsp_exact_outlines = tree_errors(TreeArithmetic::exact_outlines);
  result.bsp_exact = tree_errors(TreeArithmetic::exact);
  result.files = std::move(drawn.files);
  return result;
}

std::vector<HiddenSurfaceCase> compare_hidden_surfaces() {
  std::vector<HiddenSurfaceCase> results;
  for (const HiddenSurfaceScene& c : hidden_surface_scenes())
    results.push_back(compare_hidden_surfaces(c.name, c.scene, hidden_surface_camera()));
  return results;
}

HiddenSurfaceCost hidden_surface_cost(const Scene& scene, const Camera& camera) {
  HiddenSurfaceCost cost{.triangles = scene.meshes[0].triangles.size()};
  PipelineOptions options = z_buffer_options(Storage::float32);
  const auto draw = [&] { return render_frame(scene, camera, options, false); };
  cost.buffer = cost_of(draw).first;
  options.hidden_surface = HiddenSurface::painter;
  const auto [painter, frame] = cost_of(draw);
  cost.painter = painter;
  cost.comparisons = frame.painter.comparisons;
  cost.splits = frame.painter.splits;
  const auto [warnock_cost, windows] = cost_of([&] { return warnock(scene, camera); });
  cost.warnock = warnock_cost;
  cost.warnock_windows = windows.steps;
  const auto [tree_cost, tree] = cost_of([&] { return bsp_tree(scene, camera); });
  cost.bsp_tree = tree_cost;
  cost.bsp_tree_pieces = tree.polygons;
  return cost;
}

HiddenSurfaceCost hidden_surface_cost(std::uint32_t triangles) {
  return hidden_surface_cost(random_triangles(triangles, 9), front_camera(320, 240, 1, 20));
}

}  // namespace fathom::studies
