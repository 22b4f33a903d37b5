#include "validation/studies/hidden_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"
#include "validation/studies/page.h"
#include "validation/studies/picture.h"
#include "validation/studies/pipeline_scenes.h"
#include "validation/studies/plot.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;
using pipeline::HiddenSurface;
using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

struct Case {
  std::string name, shows;
  Scene scene;
};

Scene pair(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d, MeshPoint e, MeshPoint f) {
  return scene_of({a, b, c, d, e, f}, {{0, 1, 2}, {3, 4, 5}});
}

std::vector<Case> cases() {
  return {
      {"z-disjoint", "depths do not overlap: the farther first",
       pair({-1, -1, 4}, {1, -1, 4}, {0, 1, 4}, {-1.8, -0.9, 6}, {2.2, -0.9, 6}, {0.2, 2, 6})},
      {"nearer-zmin", "depths overlap; the one with the nearer corner is in front",
       pair({-1, -1, 4}, {1, -1, 5}, {0, 1, 5}, {-1, -0.6, 4.5}, {1, -0.6, 6}, {0, 1.2, 6})},
      {"farther-zmin", "depths overlap; the one with the farthest corner is in front",
       pair({-1, -1, 4}, {1, -1, 6}, {0.8, 1, 7}, {-1, -0.5, 4.6}, {0.3, -0.6, 5.9},
            {-0.2, 0.5, 6})},
      {"x-disjoint", "left and right: either first",
       pair({-1.2, -1, 4}, {-0.1, -1, 6}, {-0.5, 1, 5}, {0.1, -1, 5}, {1.2, -1, 4}, {0.5, 1, 6})},
      {"equal-zmax", "the farthest corners are as far",
       pair({-1, -1, 4}, {1, -1, 6}, {0, 1, 5}, {-1, -0.6, 4.5}, {1, -0.6, 6}, {0, 1.2, 5.5})},
      {"cycle", "each is in front of one and behind the other: one has to be split",
       cyclic_overlap()},
      {"penetration", "two go through each other: one has to be split", penetration()}};
}

struct Result {
  std::string name;
  std::size_t seen = 0;  ///< pixels with a surface
  std::size_t buffer16 = 0, buffer32 = 0, painter = 0;
  pipeline::PainterStatistics order;
};

std::vector<std::uint32_t> exact_ids(const Scene& scene, const Camera& camera) {
  RenderOptions options;
  options.channels = {Channel::id};
  const DepthMap map = render(scene, camera, options);
  const auto& ids = *map.values<std::uint32_t>("id");
  return {ids.begin(), ids.end()};
}

std::size_t different(const std::vector<std::uint32_t>& exact, const PipelineFrame& frame) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) count += exact[i] != frame.id[i];
  return count;
}

PipelineOptions precise() {
  PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.subpixel_bits = 16;
  options.shading = pipeline::Shading::none;
  options.depth_format.storage = Storage::float32;
  return options;
}

Result compare(const Case& c, std::vector<StudyFile>& files) {
  Camera camera = front_camera(160, 160, 1, 20);
  // No edge runs through a sample, where snapping would decide.
  camera.cx += 0.1234567;
  camera.cy += 0.7654321;
  Result result{c.name};
  const auto exact = exact_ids(c.scene, camera);
  for (const std::uint32_t id : exact) result.seen += id != no_surface;
  Scene painted = c.scene;
  paint_each_triangle(painted);
  PipelineOptions options = precise();
  result.buffer32 = different(exact, render_frame(painted, camera, options, false));
  options.depth_format.storage = Storage::unorm16;
  result.buffer16 = different(exact, render_frame(painted, camera, options, false));
  options.hidden_surface = HiddenSurface::painter;
  const PipelineFrame frame = render_frame(painted, camera, options, true);
  result.painter = different(exact, frame);
  result.order = frame.painter;
  files.push_back(picture_file(c.name, pipeline::to_rgb(frame.picture), 2));
  return result;
}

struct Cost {
  std::uint32_t triangles;
  double buffer_ms, painter_ms;
  std::uint64_t comparisons, splits;
};

/// The least time of a few frames, and the last of them.
std::pair<double, PipelineFrame> timed_frame(const Scene& scene, const Camera& camera,
                                             const PipelineOptions& options) {
  using Clock = std::chrono::steady_clock;
  std::pair<double, PipelineFrame> result{std::numeric_limits<double>::infinity(), {}};
  for (int frame = 0; frame < 5; ++frame) {
    const Clock::time_point start = Clock::now();
    result.second = render_frame(scene, camera, options, false);
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    result.first = std::min(result.first, time.count());
  }
  return result;
}

Cost cost_of(std::uint32_t count) {
  const Camera camera = front_camera(320, 240, 1, 20);
  const Scene scene = random_triangles(count, 9);
  PipelineOptions options = precise();
  const double buffer_ms = timed_frame(scene, camera, options).first;
  options.hidden_surface = HiddenSurface::painter;
  const auto [painter_ms, frame] = timed_frame(scene, camera, options);
  return {count, buffer_ms, painter_ms, frame.painter.comparisons, frame.painter.splits};
}

StudyFile page_of(const std::vector<Case>& scenes, const std::vector<Result>& results,
                  const std::vector<Cost>& costs) {
  Page page("Hidden surfaces");
  page.paragraph(
      "The z-buffer keeps the nearest depth at every pixel; the painter's algorithm paints what is "
      "far first. Both are held against the exact visible triangle, pixel by pixel, where "
      "snapping has no say (16 subpixel bits, no edge through a sample). Tests are those of "
      "Newell, Newell and Sancha: boxes "
      "disjoint in x or y, P behind the plane of Q, Q before the plane of P, projections "
      "disjoint.");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& r = results[i];
    page.picture(r.name, r.name + ": " + scenes[i].shows);
    rows.push_back({r.name, fmt::format("{}", r.seen), fmt::format("{}", r.buffer32),
                    fmt::format("{}", r.buffer16), fmt::format("{}", r.painter),
                    fmt::format("{}", r.order.moved), fmt::format("{}", r.order.splits)});
  }
  page.table({"scene", "pixels", "wrong: z-buffer float32", "z-buffer unorm16", "painter", "moved",
              "splits"},
             rows);
  page.heading("What it costs");
  page.plot("cost",
            "Time against the number of triangles, 320 by 240 pixels, this machine, the least of "
            "five frames");
  rows.clear();
  for (const Cost& c : costs)
    rows.push_back({fmt::format("{}", c.triangles), fmt::format("{:.2f}", c.buffer_ms),
                    fmt::format("{:.2f}", c.painter_ms), fmt::format("{}", c.comparisons),
                    fmt::format("{}", c.splits)});
  page.table({"triangles", "z-buffer ms", "painter ms", "comparisons", "splits"}, rows);
  page.paragraph(
      "The z-buffer needs one depth a pixel and its time grows with the fragments. The painter "
      "needs none, but every pair of triangles whose depths overlap is compared, and pieces are "
      "compared again.");
  return page.file();
}

}  // namespace

std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples)
    throw UsageError("the study hidden-surface takes no options");
  require_gnuplot();
  std::vector<StudyFile> files;
  std::vector<Result> results;
  const std::vector<Case> scenes = cases();
  results.reserve(scenes.size());
  for (const Case& c : scenes) results.push_back(compare(c, files));
  tick(0.5);
  std::vector<Cost> costs;
  Plot plot{"cost", "Z-buffer and painter", "triangles", "milliseconds"};
  plot.logarithmic_x = plot.logarithmic_y = true;
  plot.series = {{"z-buffer", {}}, {"painter", {}}};
  for (const std::uint32_t count : {10u, 30u, 100u, 300u, 1000u}) {
    costs.push_back(cost_of(count));
    plot.series[0].points.emplace_back(count, costs.back().buffer_ms);
    plot.series[1].points.emplace_back(count, costs.back().painter_ms);
    tick(0.5 + 0.1 * static_cast<double>(costs.size()));
  }
  for (StudyFile& file : draw(plot)) files.push_back(std::move(file));
  Json summary{{"study", "hidden-surface"}};
  std::string csv = "scene,pixels,wrong_float32,wrong_unorm16,wrong_painter,moved,splits\n";
  for (const Result& r : results) {
    summary["scenes"].push_back({{"scene", r.name},
                                 {"pixels", r.seen},
                                 {"wrong_float32", r.buffer32},
                                 {"wrong_unorm16", r.buffer16},
                                 {"wrong_painter", r.painter},
                                 {"moved", r.order.moved},
                                 {"splits", r.order.splits}});
    csv += fmt::format("{},{},{},{},{},{},{}\n", r.name, r.seen, r.buffer32, r.buffer16, r.painter,
                       r.order.moved, r.order.splits);
  }
  files.push_back({"scenes.csv", csv});
  files.push_back({"summary.json", summary.dump(2) + "\n"});
  files.push_back(page_of(scenes, results, costs));
  return files;
}

}  // namespace fathom::studies
