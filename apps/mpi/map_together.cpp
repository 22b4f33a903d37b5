#include <algorithm>
#include <exception>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "apps/mpi/image_rows.h"
#include "apps/mpi/render_together.h"
#include "apps/mpi/together.h"
#include "apps/options/map_arguments.h"
#include "apps/render/map_additions.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/image/exr_bands.h"
#include "fathom/image/png_files.h"
#include "fathom/render.h"

// How to read this file: MapTogether::make() is the whole story. The ranks draw the tiles of the
// image together (render_together.h). Then pixels go to the ranks that compress bands of rows, some
// rows at a time, and from there to the file.
//
// Ranks communicate only between calls of together(). Within such a call a rank works alone and may
// fail. Two exceptions: write_banded_exr() fails only after all communication, and TriangleMail
// notifies the other ranks of a failure.
namespace fathom::app {
namespace {

class MapTogether {
 public:
  MapTogether(const JobTogether& job, const Camera& camera, RenderOutputs* outputs,
              std::size_t number, MapTraffic& traffic, MapReport& report)
      : job_(job),
        ranks_(job.ranks),
        camera_(camera),
        options_(job.plan.rendering_for(camera)),
        outputs_(outputs),
        number_(number),
        traffic_(traffic),
        report_(report),
        tiles_(tiles_of(camera)),
        drawing_(job, camera, options_, traffic),
        chunks_(job.memory.chunk_bytes) {}

  void make(const std::function<void(double)>& progress) {
    Stopwatch stopwatch;
    drawing_.draw(progress);
    report_.seconds.render = stopwatch.lap();
    write();
    report_.seconds.write = stopwatch.lap() - report_.seconds.depth_format - report_.seconds.verify;
    sum_up();
  }

 private:
  void sum_up() {
    traffic_.triangles = job_.scene.first_numbers().back();
    traffic_.most_drawn = traffic_.drawn;
    app::sum_up(traffic_, ranks_);
    sum_up_statistics();
  }

  /// Sums the counts of all ranks, except the triangles of the scene, whose number is the same in
  /// all ranks.
  void sum_up_statistics() {
    report_.statistics = drawing_.statistics();
    std::vector<std::uint64_t> numbers;
    for_each_number(report_.statistics, [&](std::uint64_t n) { numbers.push_back(n); });
    ranks_.add_up(numbers);
    auto sum = numbers.begin();
    for_each_number(report_.statistics, [&](std::uint64_t& n) { n = *sum++; });
    report_.statistics.triangles = job_.scene.first_numbers().back();
  }

  // Rows of the image, some at a time.

  void write() {
    traffic_.map = outputs_ ? outputs_->map_name(number_) : job_.arguments.render.output;
    report_.map = traffic_.map;
    report_.width = camera_.width;
    report_.height = camera_.height;
    rows_of_chunk_ = rows_of_chunk(job_.plan);
    bands_ = rows_of_chunk_ ? equal_bands(tiles_.rows, ranks_.count())
                            : all_for_first(tiles_.rows, ranks_.count());
    if (rows_of_chunk_) {
      for_each_rows([&](DepthMap rows) { compress(std::move(rows)); });
      write_in_bands();
    } else {
      gather();
      find_mattes();
      sum_up_statistics();
      together(ranks_, [&] {
        if (ranks_.is_first()) write_whole();
      });
    }
  }

  /// All rows in the first rank.
  void gather() {
    std::optional<WholeMap> map;
    for_each_rows([&](DepthMap rows) {
      if (!ranks_.is_first()) return;
      if (map) {
        map->add(rows.channels);
      } else {
        map.emplace(std::move(rows), camera_.height);
      }
    });
    if (map) map_ = map->take();
  }

  /// Finds the mattes of each rank's share of the rows, and gathers all of them in the first rank.
  void find_mattes() {
    for (const MatteKind& by : job_.plan.mattes) {
      Mattes mattes;
      together(ranks_, [&] {
        mattes = fathom::find_mattes(job_.scene.outline(), camera_, options_, by, share_of(ranks_));
      });
      gather_rows(ranks_, camera_.width, mattes.counts, mattes.shares, traffic_.of_pixels);
      // Only the empty name is not one of all ranks.
      if (ranks_.greatest(mattes.names.size()) > mattes.names.size()) mattes.names.emplace_back();
      if (ranks_.is_first()) mattes_.push_back(std::move(mattes));
    }
  }

  /// How many rows of tiles of a band are assembled at a time.
  [[nodiscard]] std::uint32_t rows_at_once() const {
    constexpr std::uint64_t bytes_per_value = 8;
    // Drawn rows, received rows, and messages.
    const std::uint64_t bytes_of_row = 4 * std::uint64_t{camera_.width} * tiles_.side *
                                       count_parts(options_.channels) * bytes_per_value;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
        job_.memory.row_bytes / bytes_of_row, 1, std::max(1U, tiles_.rows)));
  }

  /// Calls take(map of some rows of this rank's band, from its first to its last), within
  /// together(): a map without channels after the last row.
  void for_each_rows(const std::function<void(DepthMap)>& take) {
    std::uint32_t most = 0;
    for (const TileRows& band : bands_) most = std::max(most, band.count());
    const std::uint32_t at_once = rows_at_once();
    for (std::uint32_t from = 0; from < most; from += at_once) {
      const std::vector<TileRows> rows = parts_of(bands_, from, at_once);
      const DrawnTiles where{tiles_, camera_.width, camera_.height, drawing_.owners()};
      const RowsDrawn drawn = [&](const TileRows& some) {
        return about_output(traffic_.map, [&] { return drawing_.rows(some); });
      };
      std::vector<files::Bytes> messages;
      together(ranks_, [&] { messages = pixels_for_others(ranks_, where, rows, drawn); });
      traffic_.of_pixels.add(messages, ranks_.self());
      messages = ranks_.exchange(std::move(messages), job_.memory.message_bytes);
      const TileRows own = rows[static_cast<std::size_t>(ranks_.self())];
      together(ranks_, [&] { take(rows_from_all(ranks_, where, own, drawn, messages)); });
    }
  }

  /// Adds the texts of the header.
  void describe(DepthMap& map) const {
    finish_map(map, job_.scene.outline(), camera_, options_, report_.statistics);
    const MotionOptions& motion = job_.arguments.render.motion;
    motion.describe(map, motion.time_or_start());
  }
  /// Adds requested channels that are not rendered.
  [[nodiscard]] DepthMap dressed(DepthMap map) const {
    return job_.plan.storage.dressed(std::move(map), traffic_.map,
                                     std::numeric_limits<double>::infinity());
  }

  void write_whole() {
    const MapPlan& plan = job_.plan;
    const std::string& name = traffic_.map;
    describe(map_);
    const auto render_again = [&](const RenderOptions& other) {
      return job_.scene.render(camera_, other);
    };
    const auto mattes = [found = mattes_.begin()](const MatteKind&) mutable {
      return std::move(*found++);
    };
    add_planned(map_, plan, name, {job_.scene.triangles(), camera_, options_, render_again, mattes},
                report_, job_.console);
    map_ = dressed(std::move(map_));
    outputs_->map(number_).write(
        [&](const auto& path) { write_map(map_, path, plan.format, plan.writing); });
    if (plan.storage.png_sidecar) outputs_->sidecar(number_).write(png_sidecar(map_));
    warn_of_codes_beyond(map_, name, job_.console);
  }

  void compress(DepthMap rows) {
    if (rows.channels.empty()) return;
    const WriteOptions& writing = job_.plan.writing;
    if (ranks_.is_first()) describe(rows);
    rows = dressed(std::move(rows));
    if (ranks_.is_first() && beginning_.empty())
      beginning_ = exr_beginning(rows, camera_.height, writing.compression, traffic_.map);
    for (files::Bytes& chunk : exr_chunks(rows, writing.compression, writing.threads, traffic_.map))
      chunks_.add(std::move(chunk));
  }

  void write_in_bands() {
    if (!ranks_.is_first()) traffic_.of_chunks = {chunks_.count(), chunks_.bytes()};
    std::vector<int> of_chunks;
    for (int rank = 0; rank < ranks_.count(); ++rank) {
      const auto [first, end] = bands_[static_cast<std::size_t>(rank)];
      const std::uint32_t end_row = std::min(end * tiles_.side, camera_.height);
      for (std::uint32_t row = first * tiles_.side; row < end_row; row += *rows_of_chunk_)
        of_chunks.push_back(rank);
    }
    const auto write_to = [&](const std::filesystem::path& path) {
      write_banded_exr(ranks_, path, beginning_, of_chunks, *rows_of_chunk_, chunks_);
    };
    together(ranks_, [&] { outputs_ ? outputs_->map(number_).write(write_to) : write_to({}); });
  }

  const JobTogether& job_;
  const Ranks& ranks_;
  const Camera& camera_;
  RenderOptions options_;
  RenderOutputs* outputs_;
  std::size_t number_;
  MapTraffic& traffic_;
  MapReport& report_;
  ImageTiles tiles_;
  TilesTogether drawing_;
  /// For an EXR that is written in bands.
  std::optional<std::uint32_t> rows_of_chunk_;
  std::vector<TileRows> bands_;
  files::Bytes beginning_;
  WaitingChunks chunks_;
  /// The whole map, in the rank that assembles it.
  DepthMap map_;
  std::vector<Mattes> mattes_;
};

}  // namespace

std::optional<std::uint32_t> rows_of_chunk(const MapPlan& plan) {
  if (plan.format != MapFormat::exr || has_additions(plan)) return std::nullopt;
  return rows_of_exr_chunk(plan.writing.compression);
}

void make_map_together(const JobTogether& job, const Camera& camera, RenderOutputs* outputs,
                       std::size_t number, const std::function<void(double)>& progress,
                       MapTraffic& traffic, MapReport& report) {
  MapTogether(job, camera, outputs, number, traffic, report).make(progress);
}

}  // namespace fathom::app
