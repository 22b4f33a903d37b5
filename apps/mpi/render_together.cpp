#include "apps/mpi/render_together.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

#include "apps/mpi/banded_exr.h"
#include "apps/mpi/image_rows.h"
#include "apps/mpi/shared_scene.h"
#include "apps/mpi/tile_rows.h"
#include "apps/mpi/together.h"
#include "apps/mpi/traffic.h"
#include "apps/mpi/triangle_messages.h"
#include "apps/render/camera_warnings.h"
#include "apps/render/map_warnings.h"
#include "apps/render/render_memory.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/thread_limit.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/progress.h"
#include "apps/shell/signals.h"
#include "apps/shell/stopwatch.h"
#include "apps/shell/text_output.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/exr_bands.h"
#include "fathom/image/png_sidecar.h"
#include "fathom/mesh/vertex_normals.h"
#include "fathom/numeric/errors.h"
#include "fathom/render.h"

// How to read this file: MapTogether::make() is the whole story. Each rank has a part of the
// triangles, finds the tiles of the image that they may touch, and sends them to the ranks that draw
// these tiles (sort-middle [MCEF94]). What has been drawn goes to the ranks that compress bands of
// rows, and from there to the file.
//
// Whatever is said to other ranks is said between calls of together(), within which a rank works by
// itself and may fail; but for write_banded_exr(), which fails only when all has been said.
namespace fathom::app {
namespace {

/// What a run is asked for, and what all its maps are made from.
struct Job {
  const MpiArguments& arguments;
  const Ranks& ranks;
  const Console& console;
  MapPlan plan;
  const SharedScene& scene;
  const ScenePart& part;
};

/// One map, from the triangles of all ranks to a file.
class MapTogether {
 public:
  MapTogether(const Job& job, const Camera& camera)
      : job_(job), camera_(camera), tiles_(tiles_of(camera)) {}

  /// Returns the sums of the statistics of all ranks, in all of them. `outputs`: in the first.
  /// traffic() then has what it took.
  RenderStatistics make(std::optional<RenderOutputs>& outputs, std::size_t number,
                        const std::function<void(double)>& progress) {
    const Ranks& ranks = job_.ranks;
    together(ranks, [&] { find_tiles(); });
    deal_out_tiles();
    std::vector<text::Bytes> messages;
    together(ranks, [&] { messages = messages_of(job_.part, touches_, owners_, ranks.count()); });
    touches_ = {};
    traffic_.of_triangles.add(messages, ranks.self());
    messages = ranks.exchange(std::move(messages));
    together(ranks, [&] { draw(std::move(messages), progress); });
    deal_out_rows();
    map_ = with_own_rows(ranks, {tiles_, camera_.width, camera_.height, owners_, of_rows_},
                         std::move(map_), traffic_.of_pixels);
    sum_up();
    if (rows_of_chunk_) {
      write_in_bands(outputs, number);
    } else {
      together(ranks, [&] {
        if (ranks.is_first()) write_whole(*outputs, number);
      });
    }
    app::sum_up(traffic_, ranks);
    return statistics_;
  }

  /// The sums of all ranks, in all of them.
  [[nodiscard]] const MapTraffic& traffic() const { return traffic_; }

 private:
  [[nodiscard]] RenderOptions options(RenderStatistics& statistics) const {
    RenderOptions options = job_.plan.rendering;
    options.statistics = &statistics;
    return options;
  }

  void find_tiles() { touches_ = tiles_touched(job_.part.scene, camera_, options(statistics_)); }

  void deal_out_tiles() {
    std::vector<std::uint64_t> triangles(tiles_.count(), 0);
    for (const TileTouch& touch : touches_) ++triangles[touch.tile];
    job_.ranks.add_up(triangles);
    owners_ = owners_of_tiles(job_.arguments.partition, tiles_.columns, tiles_.rows, triangles,
                              job_.ranks.count());
  }

  void draw(std::vector<text::Bytes> messages, const std::function<void(double)>& progress) {
    std::vector<std::uint32_t> own;
    for (std::uint32_t tile = 0; tile < owners_.size(); ++tile)
      if (owners_[tile] == job_.ranks.self()) own.push_back(tile);
    const ReceivedScene received = received_scene(std::move(messages), job_.scene);
    RenderStatistics drawn;
    RenderOptions how = options(drawn);
    how.progress = progress;
    Stopwatch stopwatch;
    map_ = render_tiles(received.scene, camera_, how, own);
    traffic_.drawing = stopwatch.lap();
    traffic_.drawn = traffic_.most_drawn = received.numbers.size();
    statistics_.pixels_with_surface = drawn.pixels_with_surface;
    number_triangles(received.numbers, own);
  }

  /// Gives the triangles that are seen the numbers that they have in the whole scene.
  void number_triangles(std::span<const std::uint32_t> numbers,
                        std::span<const std::uint32_t> own_tiles) {
    auto* const ids = map_.values<std::uint32_t>("id");
    if (ids == nullptr) return;
    const auto number_row = [&](std::uint32_t row, std::uint32_t left, std::uint32_t columns) {
      std::uint32_t* const pixels = ids->data() + std::size_t{row} * camera_.width + left;
      for (std::uint32_t i = 0; i < columns; ++i)
        if (pixels[i] != no_surface) pixels[i] = numbers[pixels[i]];
    };
    for (const std::uint32_t tile : own_tiles)
      for_each_row_of_tile(tiles_, tile, camera_.width, camera_.height, number_row);
  }

  void sum_up() {
    const Ranks& ranks = job_.ranks;
    statistics_.triangles = traffic_.triangles = job_.scene.first_numbers().back();
    statistics_.degenerate_triangles = ranks.sum(statistics_.degenerate_triangles);
    statistics_.pixels_with_surface = ranks.sum(statistics_.pixels_with_surface);
  }

  /// Bands, where the file can be put together from them; or else all rows go to the first rank.
  void deal_out_rows() {
    if (job_.plan.format == MapFormat::exr)
      rows_of_chunk_ = rows_of_exr_chunk(job_.plan.writing.compression);
    of_rows_ = rows_of_chunk_ ? equal_bands(tiles_.rows, job_.ranks.count())
                              : std::vector<int>(tiles_.rows, 0);
  }

  /// Adds what is said of the map to the rows of the first rank, and to all what is asked for.
  void dress(const std::string& name) {
    if (map_.height == 0) return;  // a rank without rows
    if (job_.ranks.is_first()) {
      finish_map(map_, job_.scene.outline(), camera_, job_.plan.rendering, statistics_);
      const MotionOptions& motion = job_.arguments.render.motion;
      motion.describe(map_, motion.time_or_start());
    }
    map_ =
        job_.plan.storage.dressed(std::move(map_), name, std::numeric_limits<double>::infinity());
  }

  void write_whole(RenderOutputs& outputs, std::size_t number) {
    const MapPlan& plan = job_.plan;
    const std::string& name = outputs.map_name(number);
    traffic_.map = name;
    dress(name);
    outputs.map(number).write(
        [&](const auto& path) { write_map(map_, path, plan.format, plan.writing); });
    if (plan.storage.png_sidecar) outputs.sidecar(number).write(png_sidecar(map_));
    warn_of_codes_beyond(map_, name, job_.console);
  }

  void write_in_bands(std::optional<RenderOutputs>& outputs, std::size_t number) {
    const Ranks& ranks = job_.ranks;
    const WriteOptions& writing = job_.plan.writing;
    const std::string name = outputs ? outputs->map_name(number) : job_.arguments.render.output;
    text::Bytes beginning;
    std::vector<text::Bytes> chunks;
    together(ranks, [&] {
      dress(name);
      if (ranks.is_first())
        beginning = exr_beginning(map_, camera_.height, writing.compression, name);
      chunks = exr_chunks(map_, writing.compression, writing.threads, name);
    });
    map_ = {};
    traffic_.map = name;
    if (!ranks.is_first()) {
      for (const text::Bytes& chunk : chunks) {
        ++traffic_.of_chunks.messages;
        traffic_.of_chunks.bytes += chunk.size();
      }
    }
    std::vector<int> of_chunks;
    for (std::uint32_t row = 0; row < camera_.height; row += *rows_of_chunk_)
      of_chunks.push_back(of_rows_[row / tiles_.side]);
    const auto write_to = [&](const std::filesystem::path& path) {
      write_banded_exr(ranks, path, beginning, of_chunks, *rows_of_chunk_, std::move(chunks));
    };
    together(ranks, [&] { outputs ? outputs->map(number).write(write_to) : write_to({}); });
  }

  const Job& job_;
  const Camera& camera_;
  ImageTiles tiles_;
  std::vector<TileTouch> touches_;
  /// The rank of each tile.
  std::vector<int> owners_;
  /// Of an EXR that is written in bands.
  std::optional<std::uint32_t> rows_of_chunk_;
  /// The rank of each row of tiles.
  std::vector<int> of_rows_;
  /// At first of the whole image, in which this rank has drawn its tiles, then of its rows.
  DepthMap map_;
  RenderStatistics statistics_;
  MapTraffic traffic_;
};

/// Channel Ns of sums over the triangles at a vertex, of which ranks may have some.
void check_normals(const SharedScene& scene, const MapPlan& plan) {
  const auto& channels = plan.rendering.channels;
  if (std::ranges::count(channels, Channel::Ns) == 0) return;
  const bool sums = std::ranges::any_of(scene.outline().meshes, [&](const Mesh& mesh) {
    return mesh::needs_sums(mesh, plan.rendering.normals);
  });
  if (sums) {
    throw UsageError(
        "--channels: Ns of normals that are sums over triangles is not for fathom-mpi yet; 'fathom "
        "render' has it");
  }
}

ScenePart own_part(const SharedScene& scene, const Ranks& ranks) {
  const std::uint64_t count = scene.first_numbers().back();
  const auto first_of = [&](int rank) {
    return count * static_cast<std::uint64_t>(rank) / static_cast<std::uint64_t>(ranks.count());
  };
  return scene.part(first_of(ranks.self()), first_of(ranks.self() + 1));
}

/// What is rendered, and how it is seen.
struct Input {
  SharedScene scene;
  ScenePart part;
  std::vector<Camera> cameras;
};

Input read_input(const Ranks& ranks, const RenderArguments& arguments, const MapPlan& plan,
                 const Console& console) {
  const bool normals = std::ranges::count(plan.rendering.channels, Channel::Ns) != 0;
  const SharedScene::Kept kept{plan.needs_segments(), normals, ranks.is_first()};
  std::optional<SharedScene> opened;
  together(ranks, [&] { opened.emplace(arguments.scene, kept, console); });
  require_same<InputError>(ranks, opened->description(), "the ranks read different files");
  Input input{std::move(*opened), {}, {}};
  SharedScene& scene = input.scene;
  // What stays in files is read before cameras, which need its bounds; what moves, after it has moved.
  together(ranks, [&] {
    if (!scene.is_whole()) input.part = own_part(scene, ranks);
  });
  scene.find_bounds(ranks, input.part);
  together(ranks, [&] {
    input.cameras = arguments.camera.get(scene.outline(), console);
    scene.place(arguments.motion);
    if (scene.is_whole()) input.part = own_part(scene, ranks);
    warn_of_missing_segments(scene.triangles(), plan.rendering.channels, console);
    check_normals(scene, plan);
    check_cameras(input.cameras, plan, arguments.output);
  });
  require_same<InputError>(ranks, to_json(input.cameras), "the ranks have different cameras");
  return input;
}

}  // namespace

int render_together(const MpiArguments& arguments, const Console& for_all) {
  const Ranks ranks;
  const RenderArguments& render = arguments.render;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();

  MapPlan plan;
  together(ranks, [&] {
    refuse_what_is_missing(render);
    plan = plan_maps(render);
  });
  const ThreadLimit limit(plan.rendering.threads);
  const Input input = read_input(ranks, render, plan, console);
  const std::vector<Camera>& cameras = input.cameras;
  std::optional<RenderOutputs> outputs;
  std::optional<TextOutput> report;
  together(ranks, [&] {
    if (!ranks.is_first()) return;
    report.emplace(arguments.traffic);
    outputs.emplace(render, cameras);
    outputs->write_cameras(to_json(cameras) + "\n");
  });

  const Job job{arguments, ranks, console, plan, input.scene, input.part};
  std::vector<MapTraffic> traffic;
  CameraWarnings warnings;
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      MapTogether map(job, cameras[i]);
      const RenderStatistics statistics =
          map.make(outputs, i, progress.reporter(i, cameras.size()));
      traffic.push_back(map.traffic());
      if (i == 0) warn_of(statistics, console);
      warnings.note(input.scene.outline(), cameras[i], statistics.pixels_with_surface);
    }
  }
  warnings.tell(console);
  together(ranks, [&] {
    if (outputs) outputs->commit();
    if (report) report->finish(as_json(traffic, ranks.count()));
  });
  say_when_interrupted("");
  return done;
}

}  // namespace fathom::app
