#include "apps/bench/bench_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "apps/bench/measurement.h"
#include "apps/bench/parts/ideas.h"
#include "apps/bench/report.h"
#include "apps/companions.h"
#include "apps/options/map_arguments.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::app {
namespace {

Peers parse_peers(const std::string& list) {
  Peers peers{.vtk = false,
              .embree = false,
              .reference = false,
              .masked_occlusion_culling = false,
              .by_default = false};
  for (const std::string& name : parse_list(list)) {
    if (name == "vtk") {
      peers.vtk = true;
    } else if (name == "embree") {
      peers.embree = true;
    } else if (name == "reference") {
      peers.reference = true;
    } else if (name == "masked-occlusion-culling") {
      peers.masked_occlusion_culling = true;
    } else if (name != "none") {
      refuse_word(name, {"vtk", "embree", "reference", "masked-occlusion-culling", "none"});
    }
  }
  if ((peers.vtk || peers.embree) && !bench::peers_are_built()) {
    throw UsageError(
        "VTK and Embree are not built in: 'scripts/fathom bench' in a clone of Fathom installs "
        "them and builds with them (-DFATHOM_PEERS=ON)");
  }
  if (peers.masked_occlusion_culling && !bench::masked_occlusion_culling_is_built()) {
    throw UsageError(
        "masked-occlusion-culling is not built in: -DFATHOM_MASKED_OCCLUSION_CULLING=FOLDER builds "
        "with a clone of GameTechDev/MaskedOcclusionCulling");
  }
  return peers;
}

/// Names of `fathom validate` for scenes that have other names here.
constexpr OtherName scenes_of_validate[] = {{"spot", "mesh"}};

std::vector<std::string> parse_scenes(const std::string& list) {
  std::vector<std::string> names = parse_list(list);
  for (const std::string& name : names) {
    const bool is_file = name.find_first_of("./") != std::string::npos;
    if (!bench::is_made_scene(name) && !is_file) {
      std::vector<std::string> existing = bench::default_scene_names();
      existing.emplace_back("room-outside");
      throw unknown_name(
          fmt::format("there is no scene '{}'; there are {}, sphere-N, city-N and mesh files", name,
                      joined(existing, ", ")),
          name, existing, scenes_of_validate);
    }
  }
  return names;
}

std::vector<int> parse_threads(const std::string& list) {
  const int all = bench::processor_count();
  std::vector<int> counts;
  for (const std::string& text : parse_list(list)) {
    const std::uint32_t count = parse_count(text);
    if (count > static_cast<std::uint32_t>(all)) {
      throw UsageError(fmt::format("{} is more than the {} processors that there are", count, all));
    }
    counts.push_back(count == 0 ? all : static_cast<int>(count));
  }
  return counts;
}

std::vector<Size> parse_sizes(const std::string& list) {
  std::vector<Size> sizes;
  for (const std::string& text : parse_list(list)) sizes.push_back(parse_size(text));
  return sizes;
}

std::vector<std::string> parse_ideas(const std::string& list) {
  std::vector<std::string> names = parse_list(list);
  const std::vector<std::string>& known = bench::idea_names();
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) refuse_word(name, known);
  }
  return names;
}

int parse_repeat(const std::string& text) {
  return static_cast<int>(std::min(parse_positive(text), 1'000'000U));
}

}  // namespace

void BenchArguments::add_to(Command& command) {
  command.option("--scene", "NAME", into(scenes, parse_scenes),
                 "Render these scenes (default: see below)");
  command.option("--size", "WxH", into(sizes, parse_sizes),
                 "Render at these image sizes (default 1920x1080; with --parts 640x360)");
  command.option("--threads", "N", into(threads, parse_threads),
                 "Use these numbers of threads (default: all processors; with --parts 1, 2, 4, …)");
  const Option peers_option =
      command.option("--peers", "NAME", into(peers, parse_peers),
                     "Compare fast and fast-kept with these renderers: vtk, embree, reference, "
                     "masked-occlusion-culling or none (default: all that are built in; the "
                     "reference engine up to 20000 triangles)");
  const Option channels_option =
      command.option("--channels", "LIST", into(channels, parse_channels),
                     "Compute these channels with Fathom's engines (default Z)");
  command.option("--repeat", "N", into(repeat, parse_repeat),
                 "Time this many frames, within 20 seconds (default 9)");
  command.option("--json", "FILE", json, "Also write the figures as JSON; - prints only JSON");
  command
      .flag("--parts", parts,
            "Measure each optimisation of the fast engine instead of comparing renderers")
      .excludes(peers_option)
      .excludes(channels_option);
  command.option("--idea", "NAME", into(ideas, parse_ideas),
                 "Measure only these optimisations: " + joined(bench::idea_names(), ", "));
}

// fathom bench

namespace {

using bench::Comparison;
using bench::Measurement;
using bench::Plan;

/// Above this many triangles the reference engine is timed only if --peers names it.
constexpr std::uint64_t bearable_triangles = 20'000;

/// Every scene at every size with every number of threads.
std::vector<Plan> plans_of(const BenchArguments& a) {
  std::vector<Plan> plans;
  const auto scenes = a.scenes.empty() ? bench::default_scene_names() : a.scenes;
  const auto sizes = a.sizes.empty() ? std::vector<Size>{{1920, 1080}} : a.sizes;
  const auto counts = a.threads.empty() ? std::vector<int>{bench::processor_count()} : a.threads;
  for (const auto& [width, height] : sizes) {
    for (const int threads : counts) {
      for (const std::string& scene : scenes) {
        plans.push_back({scene, width, height, threads, a.repeat, a.channels});
      }
    }
  }
  return plans;
}

std::vector<std::string> renderers_for(const Peers& peers, const Plan& plan,
                                       std::uint64_t triangles) {
  std::vector<std::string> renderers{"fast", "fast-kept"};
  if (peers.vtk) renderers.emplace_back("vtk");
  if (peers.embree) renderers.insert(renderers.end(), {"embree", "embree-robust"});
  if (peers.masked_occlusion_culling && plan.threads == 1) {
    renderers.emplace_back("masked-occlusion-culling");
  }
  if (peers.reference && !(peers.by_default && triangles > bearable_triangles)) {
    renderers.emplace_back("reference");
  }
  return renderers;
}

/// A renderer whose number of covered pixels differs from that of the fast engine by more than a
/// hundredth draws another picture.
void warn_of_other_pictures(const Comparison& comparison, const Console& console) {
  const auto fast = static_cast<double>(comparison.measurements.front().covered_pixels);
  for (const Measurement& m : comparison.measurements) {
    const auto covered = static_cast<double>(m.covered_pixels);
    if (fast == 0 || m.renderer == "embree-build") continue;
    if (covered < 0.99 * fast || covered > 1.01 * fast) {
      console.warn(fmt::format("{}: {} covers {} pixels, fast {}", comparison.plan.scene,
                               m.renderer, m.covered_pixels,
                               comparison.measurements.front().covered_pixels));
    }
  }
}

/// Warns if Masked Occlusion Culling was requested by name and is not in the table.
void warn_of_what_is_left_out(const Comparison& comparison, const Peers& peers,
                              const Console& console) {
  if (peers.by_default || !peers.masked_occlusion_culling) return;
  for (const Measurement& m : comparison.measurements) {
    if (m.renderer == "masked-occlusion-culling") return;
  }
  console.warn(fmt::format(
      "{}: masked-occlusion-culling {}", comparison.plan.scene,
      comparison.plan.threads == 1 ? "draws no orthographic view" : "draws with one thread only"));
}

Comparison compare(const Plan& plan, const Peers& peers, const Console& console,
                   const std::function<void(double)>& progress) {
  Comparison comparison{plan, bench::count_triangles_in_child(plan), {}};
  const std::vector<std::string> renderers = renderers_for(peers, plan, comparison.triangles);
  for (std::size_t i = 0; i < renderers.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(renderers.size()));
    for (Measurement& m : bench::measure_in_child(renderers[i], plan)) {
      comparison.measurements.push_back(std::move(m));
    }
  }
  warn_of_other_pictures(comparison, console);
  warn_of_what_is_left_out(comparison, peers, console);
  return comparison;
}

/// "vtk: VTK 9.1.0 on llvmpipe", a line for each renderer that has a description.
std::string version_lines(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> lines;
  for (const Comparison& comparison : comparisons) {
    for (const Measurement& m : comparison.measurements) {
      if (!m.description.empty()) lines.push_back(m.renderer + ": " + m.description + "\n");
    }
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return std::accumulate(lines.begin(), lines.end(), std::string());
}

int run_bench(const BenchArguments& arguments, const Console& console) {
  if (arguments.parts) return run_parts(arguments, console);
  if (!arguments.ideas.empty()) throw UsageError("--idea belongs to --parts");
  const Peers& peers = arguments.peers;
  const std::vector<Plan> plans = plans_of(arguments);
  TextOutput json(arguments.json);
  const bool shows_tables = arguments.json != "-";
  if (peers.by_default && !bench::peers_are_built()) {
    console.warn(
        "VTK and Embree are not built in: 'scripts/fathom bench' in a clone of Fathom installs "
        "them and builds "
        "with them");
  }

  const bench::Machine machine = bench::this_machine();
  if (shows_tables) print(bench::machine_line(machine));
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    {
      Progress progress(console, plans[i].scene);
      comparisons.push_back(compare(plans[i], peers, console, progress.reporter(i, plans.size())));
    }
    if (shows_tables) print(bench::table(comparisons.back()));
  }
  if (shows_tables) print(version_lines(comparisons));
  json.finish(bench::to_json(machine, comparisons) + "\n");
  return done;
}

void add_bench(Command& program) {
  Command& command = program.command(
      "bench", description_of_companion("bench"),
      "  fathom bench\n"
      "  fathom bench --scene sphere-200k,soup --threads 1,2 --json times.json\n"
      "  fathom bench --scene sphere-5k --peers reference --size 640x360\n"
      "  fathom bench --parts --scene sphere-20k --idea lanes,blocks\n"
      "\nScenes: sphere-20k, sphere-200k, sphere-2m, mesh, soup, few-large, grid-aligned,\n"
      "grid-shifted, room, scan, city, tree, text and cad (default: these), room-outside,\n"
      "sphere-N and city-N for any N, mesh files.\n"
      "Each renderer runs in a separate process, on as many processors as threads; its first\n"
      "frame is not counted. fast keeps no memory between frames. fast-kept draws into the\n"
      "previous map and keeps its memory, as vtk and embree keep their buffers. Times of vtk\n"
      "exclude read-back, times of embree exclude embree-build. masked-occlusion-culling, if\n"
      "built in, is timed with one thread, from a cleared buffer; it draws bounds of depths.\n"
      "\n--parts switches each optimisation on and off, in one process, in turn:\n"
      "lanes of binary32 and binary64, blocks before pixels, early rejection by the order of\n"
      "drawing, tiles, threads, culling. It prints times, ratios of least times, counts, and the\n"
      "pixels of the textbooks' demo with closed and half-open edges. It fails if a variant\n"
      "draws another picture. Scenes: sphere-20k, soup, few-large. All numbers of threads are\n"
      "compared with the first of --threads.");
  const auto arguments = std::make_shared<BenchArguments>();
  arguments->add_to(command);
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_bench(*arguments, console); });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "bench", fathom::app::add_bench);
}
