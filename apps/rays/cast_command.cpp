// fathom cast SCENE… --rays FILE, or --lidar FILE

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/scene_options.h"
#include "apps/rays/columns.h"
#include "apps/rays/lidar_options.h"
#include "apps/rays/ray_file.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_names.h"
#include "fathom/rays/cast.h"

namespace fathom::app {
namespace {

enum class RayQuestion { nearest, all, count, any };

struct CastArguments {
  SceneOptions scene;
  std::string rays;
  LidarOptions lidar;
  RayQuestion mode = RayQuestion::nearest;
  RaySegment segment;
  Cull cull = Cull::none;
  std::vector<HitChannel> channels{HitChannel::t, HitChannel::id};
  std::string output = "-";

  [[nodiscard]] bool is_about_hits() const {
    return mode == RayQuestion::nearest || mode == RayQuestion::all;
  }
  [[nodiscard]] CastOptions options() const { return {segment, cull, scene.threads}; }
};

RayQuestion parse_question(const std::string& text) {
  return parse_word<RayQuestion>(text, {{"nearest", RayQuestion::nearest},
                                        {"all", RayQuestion::all},
                                        {"count", RayQuestion::count},
                                        {"any", RayQuestion::any}});
}

std::vector<HitChannel> parse_hit_channels(const std::string& list) {
  return parse_distinct(list, [](const std::string& name) {
    if (const auto found = value_named(hit_channel_table, name)) return found->channel;
    throw unknown_channel(name, names_of(hit_channel_table));
  });
}

/// "t (in lengths of the direction), id (triangle), …"
std::string described_hit_channels() {
  std::vector<std::string> texts;
  for (const HitChannelDescription& each : hit_channel_table) {
    std::string& text = texts.emplace_back(each.name);
    if (each.meaning != each.name) text.append(" (").append(each.meaning).append(")");
  }
  return joined(texts);
}

/// "TMIN:TMAX" into both.
void take_segment(const std::string& text, RaySegment& segment) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t colon = text.find(':');
  if (colon == text.npos) throw UsageError("'" + text + "' is not TMIN:TMAX, such as 0:50");
  const auto end_of = [&](const std::string& end) {
    return parse_number_or(end, {{"inf", infinity}, {"-inf", -infinity}});
  };
  segment.t_min = end_of(text.substr(0, colon));
  segment.t_max = end_of(text.substr(colon + 1));
  if (segment.t_min > segment.t_max) throw UsageError("'" + text + "': TMIN is above TMAX");
}

/// A block of rays, and the number of its first ray.
struct RayBlock {
  std::span<const Ray> rays;
  std::uint64_t first = 0;
};

/// The rays of a file or of a lidar, block by block.
class RayBlocks {
 public:
  /// Reads the first block, so that a wrong file is reported before the scene is read.
  explicit RayBlocks(const CastArguments& a)
      : most_(a.mode == RayQuestion::all ? most_rays / 64 : most_rays) {
    if (a.lidar.sensor.empty()) {
      file_.emplace(a.rays);
    } else {
      lidar_.emplace(a.lidar, a.scene.threads);
    }
    read();
  }

  [[nodiscard]] const LidarScan* lidar() const { return lidar_ ? &*lidar_ : nullptr; }
  /// Without rays at the end.
  [[nodiscard]] const RayBlock& current() const { return block_; }
  /// Goes to the next block. Where rays have many hits, it has fewer rays.
  void advance(std::size_t hits) {
    const std::size_t rays = block_.rays.size();
    most_ = std::clamp(most_hits / std::max<std::size_t>(1, hits / rays), fewest_rays, most_rays);
    block_.first += rays;
    read();
  }

 private:
  static constexpr std::size_t fewest_rays = 512, most_rays = std::size_t{1} << 16;
  static constexpr std::size_t most_hits = std::size_t{1} << 18;

  void read() {
    if (lidar_) {
      const std::span<const Ray> left =
          std::span(lidar_->rays()).subspan(static_cast<std::size_t>(block_.first));
      block_.rays = left.first(std::min(most_, left.size()));
    } else {
      of_file_ = file_->next(most_);
      block_.rays = of_file_;
    }
  }

  std::optional<LidarScan> lidar_;
  std::optional<RayFile> file_;
  std::vector<Ray> of_file_;
  RayBlock block_;
  std::size_t most_;
};

/// The columns of a block. `hits_before` counts the hits of the blocks before.
std::vector<Column> columns_about_hits(const CastArguments& a, const RayScene& scene,
                                       const RayBlock& block, std::uint64_t hits_before,
                                       bool with_splits) {
  const CastOptions options = a.options();
  RayHitLists lists;
  std::vector<std::uint64_t> ray_of_hit;
  if (a.mode == RayQuestion::all) {
    lists = all_hits(scene, block.rays, options);
    for (std::size_t ray = 0; ray < block.rays.size(); ++ray)
      ray_of_hit.insert(ray_of_hit.end(), lists.splits[ray + 1] - lists.splits[ray], ray);
  } else {
    lists.hits = cast(scene, block.rays, options);
    ray_of_hit = numbers_from(0, block.rays.size());
  }
  std::vector<Column> columns = columns_of(scene.triangles(), block.rays, ray_of_hit, lists.hits,
                                           a.channels, options.threads);
  for (std::uint64_t& ray : ray_of_hit) ray += block.first;
  columns.insert(columns.begin(), Column{"ray", {}, std::move(ray_of_hit)});
  if (a.mode == RayQuestion::all && with_splits) {
    // The first split of a block is the last of the block before.
    std::vector<std::uint64_t> splits(lists.splits.begin() + (block.first == 0 ? 0 : 1),
                                      lists.splits.end());
    for (std::uint64_t& split : splits) split += hits_before;
    columns.push_back({"splits", {}, std::move(splits)});
  }
  return columns;
}

std::vector<Column> columns_about_rays(const CastArguments& a, const RayScene& scene,
                                       const RayBlock& block) {
  std::vector<Column> columns{{"ray", {}, numbers_from(block.first, block.rays.size())}};
  if (a.mode == RayQuestion::count) {
    columns.push_back({"count", {}, count_hits(scene, block.rays, a.options())});
  } else {
    const std::vector<bool> are_hit = occluded(scene, block.rays, a.options());
    columns.push_back({"occluded", {}, std::vector<std::uint32_t>(are_hit.begin(), are_hit.end())});
  }
  return columns;
}

/// Writes the points or the range image of a lidar.
int run_scan(const CastArguments& a, ScanFile file, const Console& console) {
  if (a.mode != RayQuestion::nearest)
    throw UsageError("-o: points and range images are for --mode nearest");
  OutputFile output(a.output);
  const LidarScan lidar(a.lidar, a.scene.threads);
  const Scene scene = a.scene.read(console);
  const bool has_hits = lidar.write(RayScene(scene, a.scene.threads), a.options(), file, output);
  lidar.write_rays();
  output.commit();
  if (!has_hits)
    console.warn(
        "no beam meets the scene: check --poses, --segment, and that the scene is in metres");
  return done;
}

int run_cast(const CastArguments& a, const Console& console) {
  ColumnOutput table(a.output);
  RayBlocks blocks(a);
  const Scene scene = a.scene.read(console);
  const RayScene prepared(scene, a.scene.threads);
  std::uint64_t hits = 0;
  while (!blocks.current().rays.empty()) {
    const RayBlock& block = blocks.current();
    const std::vector<Column> columns =
        a.is_about_hits() ? columns_about_hits(a, prepared, block, hits, table.is_archive())
                          : columns_about_rays(a, prepared, block);
    table.append(columns);
    hits += columns.front().rows();
    blocks.advance(columns.front().rows());
  }
  if (const LidarScan* lidar = blocks.lidar()) lidar->write_rays();
  table.finish();
  return done;
}

}  // namespace

void add_cast(Command& program) {
  const auto arguments = std::make_shared<CastArguments>();
  Command& command =
      program.command("cast", description_of_companion("cast"),
                      "  fathom cast room.json --rays rays.csv -o hits.csv\n"
                      "  fathom cast room.json --rays rays.npy --channels t,id,P,N -o hits.npz\n"
                      "  fathom cast room.json --rays rays.csv --mode any --segment 0:50\n"
                      "  fathom cast room.json --lidar sensor.json --poses path.txt -o scan.bin");
  arguments->scene.add_to(command);
  Option rays = command.option(
      "--rays", "FILE", arguments->rays,
      "CSV file with the columns x, y, z, dx, dy and dz (origin and direction of each ray; "
      "t counts lengths of the direction), or NPY file with an array of shape N×6");
  rays.excludes(arguments->lidar.add_to(command));
  command.option("--mode", "NAME", into(arguments->mode, parse_question),
                 "Find the nearest hit (default) or all hits, count them, or report whether there "
                 "is any: nearest, all, count or any");
  command.option(
      "--segment", "TMIN:TMAX",
      [arguments](const std::string& text) { take_segment(text, arguments->segment); },
      "Count hits with TMIN <= t <= TMAX (default 0:inf); TMIN may be -inf");
  command.flag("--open", arguments->segment.open, "Leave out hits at the ends of the segment");
  add_cull_option(command, arguments->cull);
  const Option channels =
      command.option("--channels", "LIST", into(arguments->channels, parse_hit_channels),
                     "Values of each hit: " + described_hit_channels() + " (default t,id)");
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this file, .csv or .npz (default -, standard output)");
  command.runs([arguments, channels](const Console& console) {
    if (channels.is_given() && !arguments->is_about_hits())
      throw UsageError("--channels is for --mode nearest and all");
    if (arguments->rays.empty() && arguments->lidar.sensor.empty())
      throw UsageError("--rays or --lidar is required");
    const std::optional<ScanFile> file = scan_file_of(arguments->output);
    arguments->lidar.check(file);
    if (!arguments->lidar.sensor.empty() && !file && !ColumnOutput::is_for(arguments->output))
      throw UsageError("-o: '" + arguments->output +
                       "' does not end in .csv, .npz, .bin, .ply, .pcd, .npy or .exr");
    if (arguments->lidar.sensor.empty() || !file) return run_cast(*arguments, console);
    if (channels.is_given()) throw UsageError("--channels is for tables, .csv and .npz");
    return run_scan(*arguments, *file, console);
  });
}

}  // namespace fathom::app
