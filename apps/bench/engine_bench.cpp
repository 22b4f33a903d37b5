#include <hwy/targets.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fathom/camera/lens.h"
#include "fathom/camera_directions.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/render.h"
#include "fathom/rendering/options.h"
#include "validation/scenes/scenes.h"

/// Times render(), from mesh and camera in memory to the complete map in memory, without any peer,
/// or with --keep render_into(), reusing the previous map and its memory:
///   engine_bench [SCENE…] [--size WxH] [--threads N] [--repeat N] [--engine fast|reference]
///                [--channels Z,id,…] [--depths binary32|binary64|scaled_unorm16] [--cull
///                back|front|none] [--lens OPENCV,-0.25,0.05,…] [--table] [--without
///                avx-512,simd,hierarchy,early-rejection] [--tiers] [--keep]
/// Scenes are named in scenes.h, or are mesh files. The first run of each is not counted. --table
/// takes the directions of the pixels as numbers. --tiers counts how many decisions and values each
/// arithmetic settled.
namespace {

using namespace fathom;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::vector<std::string> scenes;
  unsigned width = 1920, height = 1080;
  int repeat = 9;
  bool tiers = false, keep = false, table = false;
  RenderOptions options{.engine = Engine::fast};
  std::optional<Lens> lens;
};

/// The parts of a text between commas.
std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

[[noreturn]] void refuse_word(const std::string& option, const std::string& word,
                              const char* wanted) {
  throw UsageError(option + ": '" + word + "' is " + wanted);
}

std::vector<Channel> channels_of(const std::string& list) {
  std::vector<Channel> channels;
  for (const std::string& name : parts_of(list)) {
    const auto channel = channel_named(name);
    if (!channel)
      throw UsageError("--channels: '" + list + "' names a channel that does not exist");
    channels.push_back(*channel);
  }
  return channels;
}

Engine engine_named(const std::string& word) {
  if (const auto engine = value_named(all_engines, word)) return *engine;
  refuse_word("--engine", word, "neither fast nor reference");
}

/// How Z and distance are encoded.
StoredType type_named(const std::string& word) {
  if (word == "binary32") return StoredType::binary32;
  if (word == "binary64") return StoredType::binary64;
  if (word == "scaled_unorm16") return StoredType::scaled_unorm16;
  refuse_word("--depths", word, "not one of binary32, binary64 and scaled_unorm16");
}

Cull cull_named(const std::string& word) {
  if (const auto cull = value_named(all_culls, word)) return *cull;
  refuse_word("--cull", word, "not one of back, front and none");
}

/// A model and its distortion.
Lens lens_named(const std::string& list) {
  const std::vector<std::string> words = parts_of(list);
  std::vector<double> numbers;
  for (std::size_t i = 1; i < words.size(); ++i) numbers.push_back(std::atof(words[i].c_str()));
  return lens_of_numbers(words.front(), numbers);
}

/// Leaves out what makes the fast engine fast; its map stays the same.
void leave_out(const std::string& list, FastSwitches& switches) {
  for (const std::string& word : parts_of(list)) {
    if (word == "hierarchy") {
      switches.hierarchy = false;
    } else if (word == "early-rejection") {
      switches.early_rejection = false;
    } else if (word == "avx-512") {
      hwy::DisableTargets(HWY_AVX3 | HWY_AVX3_DL);
    } else if (word == "simd") {
      hwy::DisableTargets(~HWY_EMU128);  // what remains is compiled for every processor
    } else {
      refuse_word("--without", word, "not one of avx-512, simd, hierarchy and early-rejection");
    }
  }
}

bool* flag_named(const std::string& name, Arguments& arguments) {
  if (name == "--tiers") return &arguments.tiers;
  if (name == "--keep") return &arguments.keep;
  return name == "--table" ? &arguments.table : nullptr;
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (bool* const flag = flag_named(name, arguments)) {
      *flag = true;
      continue;
    }
    if (!name.starts_with("--")) {
      arguments.scenes.push_back(name);
      continue;
    }
    if (++i == argc) throw UsageError(name + " needs a value");
    const std::string value = argv[i];
    if (name == "--size") {
      if (std::sscanf(value.c_str(), "%ux%u", &arguments.width, &arguments.height) != 2) {
        throw UsageError("--size: '" + value + "' is not a size like 1280x720");
      }
    } else if (name == "--threads") {
      arguments.options.threads = std::atoi(value.c_str());
    } else if (name == "--repeat") {
      arguments.repeat = std::max(1, std::atoi(value.c_str()));
    } else if (name == "--engine") {
      arguments.options.engine = engine_named(value);
    } else if (name == "--channels") {
      arguments.options.channels = channels_of(value);
    } else if (name == "--depths") {
      arguments.options.depth_encoding.type = type_named(value);
    } else if (name == "--cull") {
      arguments.options.cull = cull_named(value);
    } else if (name == "--lens") {
      arguments.lens = lens_named(value);
    } else if (name == "--without") {
      leave_out(value, arguments.options.fast);
    } else {
      throw UsageError("there is no option " + name);
    }
  }
  if (arguments.scenes.empty()) arguments.scenes = bench::default_scene_names();
  return arguments;
}

void print_tiers(const RenderStatistics& s) {
  const auto line = [](const char* what, std::initializer_list<std::uint64_t> counts) {
    std::printf("  %-12s", what);
    for (const std::uint64_t count : counts) {
      std::printf(" %12llu", static_cast<unsigned long long>(count));
    }
    std::printf("\n");
  };
  const std::uint64_t exact = s.edges.exact + s.visibility.exact + s.range.exact;
  std::printf("  %-12s %12s %12s %12s %12s\n", "", "vectors", "binary64", "double-words", "exact");
  line("samples", {s.samples_tested - s.samples_in_binary64, s.samples_in_binary64 - exact,
                   s.double_words, exact - s.double_words});
  line("facing", {0, s.facing.interval, 0, s.facing.exact});
  line("values", {0, s.rounding.interval - s.double_word_roundings, s.double_word_roundings,
                  s.rounding.exact});
  // The middle tier: edges between exact ends, each rounded once.
  const TierCounts& areas = s.coverage_rounding;
  line("areas",
       {0, areas.interval + areas.exact - s.areas_with_exact_ends,
        s.areas_with_exact_ends - std::min(areas.exact, s.areas_with_exact_ends), areas.exact});
}

/// Gives the directions of its pixels to the camera, in place of its lens.
void see_as_table(Camera& camera) {
  Lens table{LensModel::table};
  table.directions = std::make_shared<const DirectionTable>(directions_of(camera));
  camera.projection = Projection{.lens = std::move(table)};
}

void time_scene(const std::string& name, const Arguments& arguments) {
  bench::BenchScene bench = bench::make_scene(name, arguments.width, arguments.height);
  bench.camera.projection.lens = arguments.lens;
  if (arguments.table) see_as_table(bench.camera);
  std::vector<double> milliseconds;
  std::size_t covered = 0;
  RenderMemory memory;
  const RenderContext context{.kept = arguments.keep ? &memory : nullptr};
  Rendered rendered;
  for (int run = 0; run <= arguments.repeat; ++run) {
    if (!arguments.keep) rendered = {};
    const auto start = Clock::now();
    render_into(rendered, bench.scene, bench.camera, arguments.options, context);
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    if (run > 0) milliseconds.push_back(time.count());
    if (const auto* Z = rendered.map.values<float>("Z"); Z != nullptr && run == 0) {
      covered = static_cast<std::size_t>(
          std::count_if(Z->begin(), Z->end(), [](float z) { return std::isfinite(z); }));
    }
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  std::printf("%-16s %10llu triangles %9zu pixels  median %9.2f ms  min %9.2f ms\n", name.c_str(),
              static_cast<unsigned long long>(triangle_count(bench.scene)), covered,
              milliseconds[milliseconds.size() / 2], milliseconds.front());
  if (arguments.tiers) print_tiers(rendered.statistics);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    for (const std::string& scene : arguments.scenes) time_scene(scene, arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "engine_bench: error: %s\n", error.what());
    return 2;
  }
}
