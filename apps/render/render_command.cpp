// fathom render SCENE… -o MAP

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/render/map_verification.h"
#include "apps/render/pipeline_render.h"
#include "apps/render/render_arguments.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/progress.h"
#include "fathom/area/sampled_coverage.h"
#include "fathom/camera/camera_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/render.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Engine engine_named(const std::string& name) {
  if (name == "reference") return Engine::reference;
  if (name == "fast") return Engine::fast;
  throw UsageError(
      fmt::format("--engine: '{}' does not exist; there are fast, reference and pipeline", name));
}

RenderOptions render_options(const RenderArguments& arguments, MapFormat format) {
  RenderOptions options;
  options.engine = engine_named(arguments.engine);
  if (arguments.stream && options.engine != Engine::fast) {
    throw UsageError("--stream is for the fast engine, not for " + arguments.engine);
  }
  // Where coverage cannot be written, or triangles do not stay in memory for it, depth alone.
  const bool with_coverage = format == MapFormat::exr && !arguments.stream;
  const std::string usual = with_coverage ? "Z,A" : "Z";
  options.channels = parse_channels(arguments.channels.empty() ? usual : arguments.channels);
  if (arguments.stream &&
      std::count(options.channels.begin(), options.channels.end(), Channel::A)) {
    throw UsageError("--stream does not keep the triangles that channel A needs: leave out A");
  }
  options.cull = cull_named(arguments.cull);
  options.threads = arguments.scene.thread_count();
  options.depth_encoding = arguments.storage.encoding_for(format);
  arguments.depth_buffer.check();
  if (!arguments.samples.empty()) {
    (void)sample_pattern(arguments.samples);
    if (arguments.deep)
      throw UsageError("--deep has channels of its own; --samples has none there");
    if (format != MapFormat::exr) {
      throw UsageError(arguments.output + " holds one channel; --samples needs an .exr");
    }
  }
  if (arguments.deep && arguments.depth_buffer.wanted()) {
    throw UsageError("--deep has channels of its own; --depth-format is for maps without it");
  }
  if (format != MapFormat::exr && arguments.depth_buffer.wanted()) {
    throw UsageError(arguments.output + " holds one channel; --depth-format needs an .exr");
  }
  if (format != MapFormat::exr &&
      (options.channels.size() != 1 || parts_of(options.channels.front()) != 1)) {
    throw UsageError(fmt::format("{} holds one channel, not '{}'; .exr holds them all",
                                 arguments.output, arguments.channels));
  }
  const Channel first = options.channels.front();
  if (format == MapFormat::png && (first == Channel::A || first == Channel::Zlow)) {
    throw UsageError(fmt::format("{}: a PNG holds depths or numbers, not {}; there is .exr",
                                 arguments.output, arguments.channels));
  }
  return options;
}

/// Refuses what --deep and --cryptomatte cannot be asked for with.
void check_surfaces(const RenderArguments& arguments, MapFormat format) {
  for (const auto& [name, wanted] :
       {std::pair("--deep", arguments.deep), std::pair("--cryptomatte", arguments.cryptomatte)}) {
    if (!wanted) continue;
    if (format != MapFormat::exr) {
      throw UsageError(fmt::format("{} is for .exr, not for {}", name, arguments.output));
    }
    if (arguments.stream) throw UsageError(fmt::format("{} is not for --stream", name));
  }
  if (!arguments.deep) return;
  if (!arguments.channels.empty() || arguments.cryptomatte) {
    throw UsageError("--deep has channels of its own: A, Z, ZBack, area and id; " +
                     std::string(arguments.cryptomatte ? "--cryptomatte" : "--channels") +
                     " goes into another map");
  }
  if (!arguments.verify.empty() || !arguments.statistics.empty()) {
    throw UsageError("--verify and --stats are not for --deep");
  }
}

/// Writes a deep map for each camera.
void render_deep_maps(const Scene& scene, const std::vector<Camera>& cameras,
                      const std::vector<OutputFile>& maps, RenderOptions options,
                      Compression compression, const Console& console) {
  Progress progress(console, "rendering");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    options.progress = progress.reporter(i, cameras.size());
    const DeepMap map = render_deep(scene, cameras[i], options);
    maps[i].write(
        [&](const auto& path) { write_deep_map(map, path, compression, options.threads); });
  }
}

/// Bytes that the channels of a map take.
double size_of_map(const Camera& camera, const RenderOptions& options, double more_channels = 0) {
  double channels = more_channels;
  for (const Channel channel : options.channels) {
    channels += static_cast<double>(parts_of(channel));
  }
  const double bytes_per_value =
      options.depth_encoding.type == DepthEncoding::Type::binary64 ? 8 : 4;
  return 1.0 * camera.width * camera.height * channels * bytes_per_value;
}

double memory_of_machine() {
  return 1.0 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Refuses an image that this machine cannot hold, before it tries.
void check_size(const Camera& camera, const RenderOptions& options, double more_channels) {
  const double needed = size_of_map(camera, options, more_channels), memory = memory_of_machine();
  if (needed > memory) {
    throw InputError(fmt::format(
        "an image of {}x{} pixels needs {:.1f} GB for its channels; this machine has {:.1f} GB",
        camera.width, camera.height, needed / 1e9, memory / 1e9));
  }
}

Json to_json(const TierCounts& counts) {
  return {{"interval", counts.interval}, {"exact", counts.exact}};
}

Json to_json(const RenderStatistics& statistics) {
  return {{"triangles", statistics.triangles},
          {"degenerate_triangles", statistics.degenerate_triangles},
          {"culled_triangles", statistics.culled_triangles},
          {"samples_tested", statistics.samples_tested},
          {"samples_covered", statistics.samples_covered},
          {"pixels_with_surface", statistics.pixels_with_surface},
          {"exact_setups", statistics.exact_setups},
          {"same_plane", statistics.same_plane},
          {"double_words", statistics.double_words},
          {"grid_setups", statistics.grid_setups},
          {"decisions",
           {{"facing", to_json(statistics.facing)},
            {"edges", to_json(statistics.edges)},
            {"visibility", to_json(statistics.visibility)},
            {"range", to_json(statistics.range)},
            {"coverage", to_json(statistics.coverage)},
            {"coverage_rounding", to_json(statistics.coverage_rounding)},
            {"rounding", to_json(statistics.rounding)}}}};
}

void warn_of(const RenderStatistics& statistics, const Console& console) {
  if (statistics.triangles == 0) {
    console.warn("the scene has no triangle: the map is background");
  } else if (statistics.degenerate_triangles > 0) {
    console.warn(fmt::format("{} of {} triangles are degenerate or seen edge on and cover nothing",
                             statistics.degenerate_triangles, statistics.triangles));
  }
}

/// What is rendered: a scene in memory, or one that stays in its files.
class Input {
 public:
  Input(const RenderArguments& arguments, const Console& console) {
    if (arguments.stream) {
      streamed_ = arguments.scene.stream(console);
      scene_ = outline_of(*streamed_);
    } else {
      scene_ = arguments.scene.read(console, true);
    }
  }

  /// With the bounds and sources of the scene: what cameras are made from.
  [[nodiscard]] const Scene& outline() const { return scene_; }
  [[nodiscard]] TriangleSource triangles() const {
    return streamed_ ? TriangleSource(*streamed_) : TriangleSource(scene_);
  }
  [[nodiscard]] DepthMap render(const Camera& camera, const RenderOptions& options) const {
    return streamed_ ? fathom::render(*streamed_, camera, options, limits(camera, options))
                     : fathom::render(scene_, camera, options);
  }

 private:
  /// Of the memory that the map leaves over, of this machine or allowed to this process, a quarter
  /// for tiles, a sixteenth for triangles.
  static StreamLimits limits(const Camera& camera, const RenderOptions& options) {
    double memory = memory_of_machine();
    rlimit allowed{};
    if (::getrlimit(RLIMIT_AS, &allowed) == 0 && allowed.rlim_cur != RLIM_INFINITY) {
      memory = std::min(memory, static_cast<double>(allowed.rlim_cur));
    }
    const double left = std::max(memory - size_of_map(camera, options), 0x1p28);
    StreamLimits limits;
    limits.tile_bytes = static_cast<std::uint64_t>(left / 4);
    limits.triangles_at_once = static_cast<std::uint32_t>(
        std::min<double>(limits.triangles_at_once, left / 16 / StreamLimits::bytes_per_triangle));
    return limits;
  }

  Scene scene_;
  std::optional<StreamedScene> streamed_;
};

/// A depth that the file cannot hold is told with the name of its map.
DepthMap render_to(const std::string& name, const Input& scene, const Camera& camera,
                   const RenderOptions& options) {
  try {
    return scene.render(camera, options);
  } catch (const OutputError& error) {
    throw OutputError(name + ": " + error.what());
  }
}

int run_render(RenderArguments& arguments, const Console& console) {
  const MapFormat format = arguments.storage.format_of(arguments.output);
  RenderOptions options = render_options(arguments, format);
  check_surfaces(arguments, format);
  WriteOptions write_options = arguments.storage.write_options(options.threads);
  if (arguments.deep && arguments.storage.compression.empty()) {
    write_options.compression = Compression::zips;
  }
  if (arguments.deep) check_deep_compression(write_options.compression);
  arguments.depth_buffer.prepare(options);
  arguments.camera.check();
  arguments.pipeline.expect_none();
  const std::uint64_t verified_pixels = pixels_to_verify(arguments.verify);
  // Without this the pool keeps to the number of processors and prints a warning of its own.
  std::optional<tbb::global_control> pool;
  if (options.threads > 0) {
    pool.emplace(tbb::global_control::max_allowed_parallelism,
                 static_cast<std::size_t>(options.threads));
  }

  Stopwatch stopwatch;
  const Input scene(arguments, console);
  const double seconds_reading = stopwatch.lap();
  const std::vector<Camera> cameras = arguments.camera.get(scene.outline());
  const std::vector<std::string> names = map_names("-o", arguments.output, cameras.size());
  for (const Camera& camera : cameras) {
    const double more = arguments.depth_buffer.channels() + (arguments.samples.empty() ? 0 : 1);
    check_size(camera, options, more);
    if (arguments.depth_buffer.wanted()) (void)arguments.depth_buffer.format(camera);
  }

  // Every output is opened before the work, and put in its place when all of them are written.
  std::vector<OutputFile> maps(names.begin(), names.end());
  std::vector<OutputFile> notes;
  notes.reserve(2);
  if (!arguments.save_camera.empty() && arguments.save_camera != "-") {
    notes.emplace_back(arguments.save_camera).write(fathom::to_json(cameras) + "\n");
  }

  Json report = Json::array();
  bool exact = true;
  if (arguments.deep) {
    render_deep_maps(scene.outline(), cameras, maps, options, write_options.compression, console);
  } else {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      RenderStatistics statistics;
      options.statistics = &statistics;
      options.progress = progress.reporter(i, cameras.size());
      stopwatch.lap();
      DepthMap map = render_to(names[i], scene, cameras[i], options);
      if (arguments.cryptomatte) add_cryptomatte(map, scene.outline(), cameras[i], options);
      if (!arguments.samples.empty()) {
        const SamplePattern pattern = sample_pattern(arguments.samples);
        add_sampled_coverage(map, scene.triangles(), cameras[i], pattern, options);
        map.texts["fathom.samples"] = pattern.name;
      }
      const double seconds_rendering = stopwatch.lap();
      Json depth_buffer;
      if (arguments.depth_buffer.wanted()) {
        depth_buffer = arguments.depth_buffer.add(map, scene.triangles(), cameras[i], options);
      }
      const double seconds_encoding = stopwatch.lap();
      Json verification = Json::object();
      if (verified_pixels > 0) {
        exact &= verify_map(
            map, names[i], {scene.triangles(), cameras[i], options, verified_pixels},
            [&](const RenderOptions& o) { (void)scene.render(cameras[i], o); }, console,
            verification);
      }
      const double seconds_verifying = stopwatch.lap();
      arguments.depth_buffer.drop_added(map);
      maps[i].write([&](const auto& path) { write_map(map, path, format, write_options); });

      if (i == 0) warn_of(statistics, console);
      Json entry{{"map", names[i]},
                 {"engine", arguments.engine},
                 {"width", map.width},
                 {"height", map.height}};
      entry.update(to_json(statistics));
      entry.update(verification);
      entry["seconds"] = {
          {"read", seconds_reading}, {"render", seconds_rendering}, {"write", stopwatch.lap()}};
      if (verified_pixels > 0) entry["seconds"]["verify"] = seconds_verifying;
      if (arguments.depth_buffer.wanted()) {
        entry["depth_format"] = depth_buffer;
        entry["seconds"]["depth_format"] = seconds_encoding;
      }
      report.push_back(std::move(entry));
    }
  }
  const std::string statistics = (report.size() == 1 ? report[0] : report).dump(2) + "\n";
  if (!arguments.statistics.empty() && arguments.statistics != "-") {
    notes.emplace_back(arguments.statistics).write(statistics);
  }

  for (OutputFile& output : notes) output.commit();
  for (OutputFile& output : maps) output.commit();
  if (arguments.save_camera == "-") print(fathom::to_json(cameras) + "\n");
  if (arguments.statistics == "-") print(statistics);
  return exact ? done : answer_is_no;
}

}  // namespace

void add_render(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_command(
      "render", "Render an exact depth map of a scene",
      "  fathom render data/meshes/spot.obj -o spot.exr\n"
      "  fathom render room.json --camera camera.json --channels Z,id,N -o room.exr\n"
      "  fathom render spot.obj --view 90,0 --size 640x480 --save-camera side.json -o side.pfm\n"
      "  fathom render spot.obj -o spot.png --png-scale 1000      (16 bit, millimetres)\n"
      "  fathom render city.stl --stream --size 16384x16384 -o city.exr\n"
      "  fathom render scan.ply --engine fast --verify 1000 -o scan.exr\n"
      "  fathom render room.json --deep -o room.deep.exr\n"
      "  fathom render spot.obj --camera path.json -o 'view-{index:04}.exr'\n"
      "  fathom render spot.obj --near 0.1 --far 100 --depth-format unorm16 --against-exact -o "
      "stored.exr\n"
      "  fathom render spot.obj --engine pipeline --shading phong --antialias msaa:4 --image "
      "spot.png "
      "-o spot.exr");
  arguments->scene.add_to(*command);
  command
      ->add_option("-o,--output", arguments->output,
                   "The map; its suffix decides the format: .exr, .pfm, .png (16 bit) or .npy")
      ->required();
  arguments->camera.add_to(*command);
  command->add_option("--save-camera", arguments->save_camera,
                      "Write the camera to this file (JSON; - is standard output)");
  command->add_option(
      "--channels", arguments->channels,
      "Of Z, A, Zlow, distance, id, face, object, N, P, bary (default Z,A in EXR, otherwise Z)");
  command->add_flag("--deep", arguments->deep,
                    "Write a deep EXR: for each pixel the visible fragments, sorted, with their "
                    "depths Z and ZBack, triangle id, exact area and alpha A");
  command->add_flag("--cryptomatte", arguments->cryptomatte,
                    "Add Cryptomatte channels by object with exact coverage to the EXR");
  command->add_option("--engine", arguments->engine,
                      "fast (default), reference: the same map bit for bit, slowly; or pipeline: "
                      "what a graphics pipeline computes");
  add_cull_option(*command, arguments->cull);
  arguments->storage.add_to(*command);
  arguments->depth_buffer.add_to(*command);
  command->add_option("--samples", arguments->samples,
                      "Add coverage by samples, channel Asampled: the share of the samples of a "
                      "pixel at which a surface counts. 1, 2, 4, 8, 16 (the standard positions of "
                      "Direct3D and Vulkan), rotated-grid, regular:N, jittered:N or "
                      "jittered:N:SEED (N by N samples)");
  command->add_flag("--stream", arguments->stream,
                    "Leave the meshes, binary STL or PLY, in their files, which may be larger than "
                    "memory; implies --engine fast");
  command->add_option("--stats", arguments->statistics,
                      "Write what was decided how to this file (JSON; - is standard output)");
  command->add_option(
      "--verify", arguments->verify,
      "Compute this many pixels, or all, again by exact arithmetic and compare every "
      "channel bit for bit; exit status 1 if one differs");
  arguments->pipeline.add_to(*command);
  command->callback([arguments, &program] {
    program.run = [arguments, &program] {
      return arguments->engine == "pipeline" ? run_pipeline_render(*arguments, program.console)
                                             : run_render(*arguments, program.console);
    };
  });
}

}  // namespace fathom::app
