#include "apps/mpi/render_together.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "apps/mpi/image_rows.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/together.h"
#include "apps/mpi/traffic.h"
#include "apps/mpi/triangle_mail.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/deep_map.h"
#include "fathom/render.h"

// How to read this file: draw() is the whole story. Each rank has a part of the triangles and takes
// it in rounds. It finds the tiles of the image that they may touch, draws its own tiles, and sends
// the triangles that touch others to the ranks that draw these (sort-middle [MCEF94]).

namespace fathom::app {

TilesTogether::TilesTogether(const JobTogether& job, const Camera& camera,
                             const RenderOptions& options, MapTraffic& traffic)
    : job_(job),
      ranks_(job.ranks),
      camera_(camera),
      options_(options),
      traffic_(traffic),
      triangles_(job.scene.triangles()),
      own_(job.scene.part_of(job.ranks)) {}

void TilesTogether::draw(const std::function<void(double)>& progress) {
  together(ranks_, [&] {
    drawing_.emplace(triangles_, camera_, options_,
                     TilesInRounds::Limits{.tile_bytes = job_.memory.tile_bytes,
                                           .kept_bytes = job_.memory.kept_bytes});
  });
  const bool is_one_round = ranks_.greatest(own_.count()) <= triangles_at_once();
  std::optional<SortedTriangles> all;
  if (is_one_round) {
    all = deal_out_by_all();
  } else {
    deal_out_by_sample();
  }
  together(ranks_, [&] {
    TriangleMail mail(ranks_, job_.memory.waiting_bytes / drawing_->view_count(),
                      traffic_.of_triangles, [&](std::vector<SomeTriangles> received) {
                        draw(drawing_->sort_again(std::move(received)));
                      });
    if (all) {
      draw_read(*all, mail);
    } else {
      draw_in_rounds(mail, progress);
    }
    all.reset();
    mail.end();
  });
}

SortedTriangles TilesTogether::deal_out_by_all() {
  std::vector<std::uint64_t> counts(tiles_of(camera_).count(), 0);
  SortedTriangles all;
  together(ranks_, [&] {
    all = drawing_->sort(job_.scene.read(own_));
    all.count(counts);
  });
  deal_out_tiles(std::move(counts));
  return all;
}

// Measures the load by a sample: as many triangles as a round has, from all over the part. Each
// represents the triangles around it.
void TilesTogether::deal_out_by_sample() {
  constexpr std::uint64_t places = 64;
  std::vector<std::uint64_t> counts(tiles_of(camera_).count(), 0);
  const std::uint64_t length = std::max<std::uint64_t>(1, triangles_at_once() / places);
  std::uint64_t taken = 0;
  together(ranks_, [&] {
    std::vector<SomeTriangles> sample;
    for (std::uint64_t place = 0; place < places; ++place) {
      const TriangleRange some = own_.part(own_.count() * place / places, length);
      std::ranges::move(job_.scene.read(some), std::back_inserter(sample));
      taken += some.count();
    }
    drawing_->sort_again(std::move(sample)).count(counts);
  });
  if (taken != 0)
    for (std::uint64_t& count : counts) count = count * own_.count() / taken;
  deal_out_tiles(std::move(counts));
}

void TilesTogether::deal_out_tiles(std::vector<std::uint64_t> triangles) {
  ranks_.add_up(triangles);
  const ImageTiles tiles = tiles_of(camera_);
  owners_ = owners_of_tiles(job_.arguments.partition, tiles.columns, tiles.rows, triangles,
                            ranks_.count());
  std::vector<std::uint32_t> own;
  for (std::uint32_t tile = 0; tile < owners_.size(); ++tile)
    if (is_own(tile)) own.push_back(tile);
  together(ranks_, [&] { drawing_->choose(std::move(own)); });
}

// Each rank works at its own pace and draws received triangles between rounds.
void TilesTogether::draw_in_rounds(TriangleMail& mail,
                                   const std::function<void(double)>& progress) {
  const std::uint64_t at_once = triangles_at_once();
  for (std::uint64_t next = 0; next < own_.count() && !mail.is_given_up(); next += at_once) {
    draw_read(drawing_->sort(job_.scene.read(own_.part(next, at_once))), mail);
    // Drawing takes most of the time. Writing is assumed to take a tenth.
    if (progress) progress(0.9 * static_cast<double>(next) / static_cast<double>(own_.count()));
  }
}

// Sends triangles that touch tiles of other ranks to these ranks, some triangles at a time: copies
// of all of them would take nearly as much memory as the round.
void TilesTogether::draw_read(const SortedTriangles& sorted, TriangleMail& mail) {
  draw(sorted);
  if (ranks_.count() == 1) return;
  std::vector<TileTouch> touches =
      sorted.touches([&](std::uint32_t tile) { return !is_own(tile); });
  std::ranges::sort(touches, {}, &TileTouch::triangle);
  const std::size_t at_once = job_.memory.sent_at_once;
  for (auto first = touches.begin(); first != touches.end();) {
    auto end = first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                           at_once, static_cast<std::size_t>(touches.end() - first)));
    // A triangle goes to each rank once.
    while (end != touches.end() && end->triangle == (end - 1)->triangle) ++end;
    mail.send(messages_of(sorted.triangles(), {first, end}, owners_, ranks_.count()));
    first = end;
  }
  mail.receive();
}

void TilesTogether::draw(const SortedTriangles& sorted) {
  Stopwatch stopwatch;
  drawing_->draw(sorted);
  traffic_.drawing += stopwatch.lap();
  if (!job_.arguments.traffic.empty())
    traffic_.drawn += sorted.count_triangles([&](std::uint32_t tile) { return is_own(tile); });
}

std::uint32_t TilesTogether::triangles_at_once() const {
  return std::max(1U, job_.memory.triangles_at_once / drawing_->view_count());
}

bool TilesTogether::is_own(std::uint32_t tile) const {
  return owners_[tile] == ranks_.self();
}

DepthMap TilesTogether::rows(const TileRows& rows) {
  Stopwatch stopwatch;
  DepthMap map = drawing_->rows(rows.first, rows.end);
  traffic_.drawing += stopwatch.lap();
  return map;
}

namespace {

/// Outputs of a run, all written by its first rank: the outputs of a single process, and the
/// traffic between ranks.
class RunOutputs {
 public:
  /// Writes the cameras.
  /// Fails    as RenderOutputs and TextOutput.
  RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras);

  [[nodiscard]] RenderOutputs& of_render() { return of_render_; }

  /// Puts all of them in their places. `traffic`: of all maps.
  void commit(const std::vector<MapTraffic>& traffic, int ranks);

 private:
  TextOutput traffic_;
  RenderOutputs of_render_;
};

RunOutputs::RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras)
    : traffic_(arguments.traffic), of_render_(arguments.render, cameras) {
  of_render_.write_cameras(to_json(cameras) + "\n");
}

void RunOutputs::commit(const std::vector<MapTraffic>& traffic, int ranks) {
  of_render_.commit();
  traffic_.finish(as_json(traffic, ranks));
}

/// In the first rank, with the samples of all.
DeepMap make_deep_map(const Ranks& ranks, const Scene& scene, const Camera& camera,
                      const RenderOptions& options, const std::function<void(double)>& progress,
                      MapTraffic& traffic) {
  DeepMap map;
  Stopwatch stopwatch;
  together(ranks, [&] { map = render_deep(scene, camera, options, share_of(ranks), progress); });
  traffic.drawing = stopwatch.lap();
  gather_rows(ranks, camera.width, map.counts, map.samples, traffic.of_pixels);
  return map;
}

/// `fathom-mpi render --deep`: every rank has the whole scene and makes a share of the rows, and
/// the first writes what all have made. Called by all ranks. Returns the exit status.
int render_deep_together(const Ranks& ranks, const MpiArguments& arguments,
                         const Console& console) {
  const RenderArguments& render = arguments.render;
  DeepMapPlan plan;
  together(ranks, [&] { plan = plan_deep_maps(render); });
  const ThreadLimit limit(plan.rendering.threads);
  SharedScene shared =
      open_scene(ranks, render, {.whole = true, .hash = ranks.is_first()}, console);
  const std::vector<Camera> cameras = cameras_of(ranks, render, {}, shared, console);
  const Scene& scene = shared.outline();
  std::optional<RunOutputs> outputs;  // in the first rank
  together(ranks, [&] {
    check_cameras(cameras, plan, render.output);
    if (ranks.is_first()) outputs.emplace(arguments, cameras);
  });
  CameraWarnings warnings;
  std::vector<MapTraffic> traffic(cameras.size());
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      traffic[i].triangles = traffic[i].drawn = shared.first_numbers().back();
      traffic[i].most_drawn = traffic[i].drawn;
      DeepMap map = make_deep_map(ranks, scene, cameras[i], plan.rendering,
                                  progress.reporter(i, cameras.size()), traffic[i]);
      sum_up(traffic[i], ranks);
      together(ranks, [&] {
        if (!outputs) return;
        traffic[i].map = outputs->of_render().map_name(i);
        render.motion.describe(map.description, render.motion.time_or_start());
        outputs->of_render().map(i).write([&](const auto& path) {
          write_deep_map(map, path, plan.compression, plan.rendering.threads);
        });
        warnings.note(scene, cameras[i], map);
      });
    }
  }
  warnings.tell(console);
  together(ranks, [&] {
    if (outputs) outputs->commit(traffic, ranks.count());
  });
  say_when_interrupted("");
  return done;
}

RankMemory memory_for(const Ranks& ranks, const MpiArguments& arguments, const MapPlan& plan) {
  const bool by_area = std::ranges::count(plan.rendering.channels, Channel::A) != 0;
  return memory_of_rank(ranks, arguments.memory, by_area);
}

SharedScene::Kept kept_for(const Ranks& ranks, const RenderArguments& arguments,
                           const MapPlan& plan) {
  return {.whole = arguments.motion.is_given() || !plan.mattes.empty(),
          .segments = plan.needs_segments(),
          .normals = std::ranges::count(plan.rendering.channels, Channel::Ns) != 0,
          .hash = ranks.is_first()};
}

/// Returns the exit status.
int render_maps(const JobTogether& job, const std::vector<Camera>& cameras,
                double seconds_reading) {
  const Ranks& ranks = job.ranks;
  const RenderArguments& arguments = job.arguments.render;
  std::optional<RunOutputs> outputs;  // in the first rank
  together(ranks, [&] {
    check_cameras(cameras, job.plan, arguments.output, rows_of_chunk(job.plan).has_value());
    if (ranks.is_first()) outputs.emplace(job.arguments, cameras);
  });
  keep_what_rounds_give_back();
  std::vector<MapTraffic> traffic(cameras.size());
  std::vector<MapReport> reports(cameras.size());
  CameraWarnings warnings;
  {
    Progress progress(job.console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      make_map_together(job, cameras[i], outputs ? &outputs->of_render() : nullptr, i,
                        progress.reporter(i, cameras.size()), traffic[i], reports[i]);
      reports[i].seconds.read = seconds_reading;
      const RenderStatistics& statistics = reports[i].statistics;
      if (i == 0) warn_of(statistics, job.console);
      warnings.note(job.scene.outline(), cameras[i], statistics.pixels_with_surface);
    }
  }
  warnings.tell(job.console);
  together(ranks, [&] {
    if (!outputs) return;
    outputs->of_render().write_statistics(as_json(reports));
    outputs->commit(traffic, ranks.count());
  });
  // Only the first rank has the result of the verification.
  const bool differs = std::ranges::any_of(reports, [](const MapReport& each) {
    return each.verification && !each.verification->agrees();
  });
  return ranks.sum(differs ? 1 : 0) == 0 ? done : answer_is_no;
}

}  // namespace

int render_together(const MpiArguments& given, const Console& for_all) {
  const Ranks ranks;
  MpiArguments arguments = given;
  const RenderArguments& render = arguments.render;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();

  MapPlan plan;
  together(ranks, [&] {
    arguments.render = given.render.of_only_output("fathom-mpi");
    refuse_what_is_missing(render);
    if (!render.deep) plan = plan_maps(render);
  });
  if (render.deep) return render_deep_together(ranks, arguments, console);
  const ThreadLimit limit(plan.rendering.threads);
  const RankMemory memory = memory_for(ranks, arguments, plan);
  Stopwatch stopwatch;
  SharedScene scene = open_scene(ranks, render, kept_for(ranks, render, plan), console);
  scene.find_bounds(ranks, memory.triangles_at_once);
  const std::vector<Camera> cameras =
      cameras_of(ranks, render, plan.rendering.channels, scene, console);
  const int status =
      render_maps({arguments, ranks, console, plan, scene, memory}, cameras, stopwatch.lap());
  say_when_interrupted("");
  return status;
}

int render_scene_together(const MpiArguments& arguments, const SharedScene& scene,
                          const std::vector<Camera>& cameras, const Console& for_all) {
  const Ranks ranks;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();
  MapPlan plan;
  together(ranks, [&] { plan = plan_maps(arguments.render); });
  const ThreadLimit limit(plan.rendering.threads);
  const RankMemory memory = memory_for(ranks, arguments, plan);
  return render_maps({arguments, ranks, console, plan, scene, memory}, cameras, 0);
}

}  // namespace fathom::app
