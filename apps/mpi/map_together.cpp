#include "apps/mpi/map_together.h"

#include <algorithm>
#include <array>
#include <bit>
#include <exception>
#include <filesystem>
#include <iterator>
#include <limits>
#include <utility>

#include "apps/mpi/banded_exr.h"
#include "apps/mpi/image_rows.h"
#include "apps/mpi/together.h"
#include "apps/mpi/triangle_messages.h"
#include "apps/mpi/waiting_chunks.h"
#include "apps/options/channel_list.h"
#include "apps/render/map_additions.h"
#include "apps/render/map_warnings.h"
#include "apps/shell/stopwatch.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/image/exr_bands.h"
#include "fathom/image/png_sidecar.h"
#include "fathom/render.h"

// How to read this file: MapTogether::make() is the whole story. Each rank has a part of the
// triangles and takes it in rounds. It finds the tiles of the image that they may touch, draws its
// own tiles, and sends the triangles that touch others to the ranks that draw these (sort-middle
// [MCEF94]). When all is drawn, pixels go to the ranks that compress bands of rows, some rows at a
// time, and from there to the file.
//
// Whatever is said to other ranks is said between calls of together(), within which a rank works by
// itself and may fail; but for write_banded_exr(), which fails only when all has been said.
namespace fathom::app {
namespace {

class MapTogether {
 public:
  MapTogether(const JobTogether& job, const Camera& camera, std::optional<RenderOutputs>& outputs,
              std::size_t number, MapTraffic& traffic, MapReport& report)
      : job_(job),
        ranks_(job.ranks),
        camera_(camera),
        outputs_(outputs),
        number_(number),
        traffic_(traffic),
        report_(report),
        tiles_(tiles_of(camera)),
        triangles_(job.scene.triangles()),
        own_(job.scene.part_of(job.ranks)),
        chunks_(job.memory.chunk_bytes) {}

  void make(const std::function<void(double)>& progress) {
    progress_ = progress;
    Stopwatch stopwatch;
    together(ranks_, [&] {
      drawing_.emplace(triangles_, camera_, job_.plan.rendering,
                       TilesInRounds::Limits{.tile_bytes = job_.memory.tile_bytes,
                                             .kept_bytes = job_.memory.kept_bytes});
    });
    if (ranks_.greatest(own_.count()) <= job_.memory.triangles_at_once) {
      draw_at_once();
    } else {
      deal_out_by_sample();
      draw_in_rounds();
    }
    together(ranks_, [&] { draw_received(); });
    report_.seconds.render = stopwatch.lap();
    write();
    report_.seconds.write = stopwatch.lap() - report_.seconds.depth_format - report_.seconds.verify;
    sum_up();
  }

 private:
  [[nodiscard]] bool is_own(std::uint32_t tile) const { return owners_[tile] == ranks_.self(); }
  [[nodiscard]] auto own_tiles() const {
    return [this](std::uint32_t tile) { return is_own(tile); };
  }
  [[nodiscard]] auto tiles_of_others() const {
    return [this](std::uint32_t tile) { return !is_own(tile); };
  }

  /// Drawing takes most of the time, and writing the rest: a tenth, say.
  void report(double share_of_drawing) const {
    if (progress_) progress_(0.9 * share_of_drawing);
  }

  // Drawing.

  void draw_at_once() {
    std::vector<std::uint64_t> counts(tiles_.count(), 0);
    SortedTriangles sorted;
    together(ranks_, [&] {
      sorted = drawing_->sort(job_.scene.read(own_));
      sorted.count(counts);
    });
    deal_out_tiles(std::move(counts));
    together(ranks_, [&] {
      draw_read(sorted);
      sorted = {};
    });
    exchange();
  }

  /// By as many triangles as a round has, taken all over the part; each stands for those around it.
  void deal_out_by_sample() {
    constexpr std::uint64_t places = 64;
    std::vector<std::uint64_t> counts(tiles_.count(), 0);
    const std::uint64_t length = std::max<std::uint64_t>(1, job_.memory.triangles_at_once / places);
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

  void deal_out_tiles(std::vector<std::uint64_t> triangles) {
    ranks_.add_up(triangles);
    owners_ = owners_of_tiles(job_.arguments.partition, tiles_.columns, tiles_.rows, triangles,
                              ranks_.count());
    std::vector<std::uint32_t> own;
    for (std::uint32_t tile = 0; tile < owners_.size(); ++tile)
      if (is_own(tile)) own.push_back(tile);
    together(ranks_, [&] { drawing_->choose(std::move(own)); });
  }

  /// Ranks wait for each other after several rounds of each, so that a round that takes long in one of
  /// them is made up for; after fewer, where many triangles are for others.
  void draw_in_rounds() {
    constexpr int most_rounds = 128;
    const std::uint64_t at_once = job_.memory.triangles_at_once;
    std::uint64_t next = 0, left = 0;
    do {
      together(ranks_, [&] {
        draw_received();
        for (int i = 0; i < most_rounds && next < own_.count() && !has_much_to_send(); ++i) {
          draw_read(drawing_->sort(job_.scene.read(own_.part(next, at_once))));
          next = std::min(next + at_once, own_.count());
        }
      });
      exchange();
      left = ranks_.greatest(own_.count() - next);
      report(1 - static_cast<double>(left) / static_cast<double>(own_.count() + 1));
    } while (left != 0);
  }

  /// Each rank gets as much from all others together as one of them may send.
  [[nodiscard]] bool has_much_to_send() const {
    const std::size_t most = job_.memory.message_bytes / static_cast<std::size_t>(ranks_.count());
    return std::ranges::any_of(messages_, [&](const auto& each) { return each.size() >= most; });
  }

  /// What touches tiles of other ranks is for them.
  void draw_read(const SortedTriangles& sorted) {
    messages_.resize(static_cast<std::size_t>(ranks_.count()));
    if (ranks_.count() > 1) {
      const std::vector<text::Bytes> more = messages_of(
          sorted.triangles(), sorted.touches(tiles_of_others()), owners_, ranks_.count());
      for (std::size_t i = 0; i < more.size(); ++i) append(messages_[i], more[i]);
    }
    draw(sorted);
  }

  void exchange() {
    messages_.resize(static_cast<std::size_t>(ranks_.count()));
    traffic_.of_triangles.add(messages_, ranks_.self());
    messages_ = ranks_.exchange(std::move(messages_), job_.memory.message_bytes);
  }

  void draw_received() {
    draw(drawing_->sort_again(received_triangles(std::exchange(messages_, {}))));
  }

  void draw(const SortedTriangles& sorted) {
    Stopwatch stopwatch;
    drawing_->draw(sorted);
    traffic_.drawing += stopwatch.lap();
    if (!job_.arguments.traffic.empty()) traffic_.drawn += sorted.count_triangles(own_tiles());
  }

  void sum_up() {
    traffic_.triangles = job_.scene.first_numbers().back();
    traffic_.most_drawn = traffic_.drawn;
    app::sum_up(traffic_, ranks_);
    sum_up_statistics();
  }

  /// What each rank has counted, but for the triangles of the scene, which all know.
  void sum_up_statistics() {
    using Counts = std::array<std::uint64_t, sizeof(RenderStatistics) / sizeof(std::uint64_t)>;
    auto counts = std::bit_cast<Counts>(drawing_->statistics());
    ranks_.add_up(counts);
    report_.statistics = std::bit_cast<RenderStatistics>(counts);
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

  /// How many rows of tiles of a band are put together at a time.
  [[nodiscard]] std::uint32_t rows_at_once() const {
    constexpr std::uint64_t bytes_per_value = 8;
    // What has been drawn, what came, and its messages.
    const std::uint64_t bytes_of_row = 4 * std::uint64_t{camera_.width} * tiles_.side *
                                       count_parts(job_.plan.rendering.channels) * bytes_per_value;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
        job_.memory.row_bytes / bytes_of_row, 1, std::max(1U, tiles_.rows)));
  }

  /// Calls take(map of some rows of this rank's band, from its first to its last), within together(): a
  /// map without channels where there are none left.
  void for_each_rows(const std::function<void(DepthMap)>& take) {
    std::uint32_t most = 0;
    for (const TileRows& band : bands_) most = std::max(most, band.count());
    const std::uint32_t at_once = rows_at_once();
    for (std::uint32_t from = 0; from < most; from += at_once) {
      const std::vector<TileRows> rows = parts_of(bands_, from, at_once);
      const DrawnTiles where{tiles_, camera_.width, camera_.height, owners_};
      const RowsDrawn drawn = [&](const TileRows& some) {
        Stopwatch stopwatch;
        DepthMap map = drawing_->rows(some.first, some.end);
        traffic_.drawing += stopwatch.lap();
        return map;
      };
      std::vector<text::Bytes> messages;
      together(ranks_, [&] { messages = pixels_for_others(ranks_, where, rows, drawn); });
      traffic_.of_pixels.add(messages, ranks_.self());
      messages = ranks_.exchange(std::move(messages), job_.memory.message_bytes);
      const TileRows own = rows[static_cast<std::size_t>(ranks_.self())];
      together(ranks_, [&] { take(rows_from_all(ranks_, where, own, drawn, messages)); });
    }
  }

  /// Adds what is said of the map.
  void describe(DepthMap& map) const {
    finish_map(map, job_.scene.outline(), camera_, job_.plan.rendering, report_.statistics);
    const MotionOptions& motion = job_.arguments.render.motion;
    motion.describe(map, motion.time_or_start());
  }
  /// Adds what is asked for beside the channels that are rendered.
  [[nodiscard]] DepthMap dressed(DepthMap map) const {
    return job_.plan.storage.dressed(std::move(map), traffic_.map,
                                     std::numeric_limits<double>::infinity());
  }

  void write_whole() {
    const MapPlan& plan = job_.plan;
    const std::string& name = traffic_.map;
    describe(map_);
    const auto render_again = [&](const RenderOptions& o) { (void)job_.scene.render(camera_, o); };
    add_planned(map_, plan, name,
                {job_.scene.outline(), triangles_, camera_, plan.rendering, render_again}, report_,
                job_.console);
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
    for (text::Bytes& chunk : exr_chunks(rows, writing.compression, writing.threads, traffic_.map))
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
  std::optional<RenderOutputs>& outputs_;
  std::size_t number_;
  MapTraffic& traffic_;
  MapReport& report_;
  ImageTiles tiles_;
  TriangleSource triangles_;
  /// What this rank reads.
  TriangleRange own_;
  std::function<void(double)> progress_;
  std::optional<TilesInRounds> drawing_;
  /// The rank of each tile.
  std::vector<int> owners_;
  /// Triangles for each rank, then from each rank.
  std::vector<text::Bytes> messages_;
  /// Of an EXR that is written in bands.
  std::optional<std::uint32_t> rows_of_chunk_;
  std::vector<TileRows> bands_;
  text::Bytes beginning_;
  WaitingChunks chunks_;
  /// Where it is put together in one rank, in that one.
  DepthMap map_;
};

}  // namespace

std::optional<std::uint32_t> rows_of_chunk(const MapPlan& plan) {
  if (plan.format != MapFormat::exr || has_additions(plan)) return std::nullopt;
  return rows_of_exr_chunk(plan.writing.compression);
}

void make_map_together(const JobTogether& job, const Camera& camera,
                       std::optional<RenderOutputs>& outputs, std::size_t number,
                       const std::function<void(double)>& progress, MapTraffic& traffic,
                       MapReport& report) {
  MapTogether(job, camera, outputs, number, traffic, report).make(progress);
}

}  // namespace fathom::app
