#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/render_options.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program_main.h"
#include "apps/shell/progress.h"
#include "fathom/numeric/errors.h"
#include "validation/bench/in_child.h"
#include "validation/bench/processors.h"
#include "validation/bench/renderers.h"
#include "validation/bench/report.h"
#include "validation/bench/scenes.h"

namespace fathom::app {
namespace {

using bench::Comparison;
using bench::Measurement;
using bench::Plan;

/// Above this many triangles the reference engine is timed only where --peers asks for it.
constexpr std::uint64_t bearable_triangles = 20'000;

struct BenchArguments {
  std::string scenes, sizes = "1920x1080", threads, peers, channels = "Z", repeat = "9", json;
};

/// What --peers names, or what there is.
struct Peers {
  bool vtk = false, embree = false, reference = false;
  /// No --peers: the reference engine where it is bearable.
  bool by_default = false;
};

Peers parse_peers(const std::string& list) {
  if (list.empty()) {
    const bool built = bench::peers_are_built();
    return {.vtk = built, .embree = built, .reference = true, .by_default = true};
  }
  Peers peers;
  for (const std::string& name : split_list(list)) {
    if (name == "vtk") {
      peers.vtk = true;
    } else if (name == "embree") {
      peers.embree = true;
    } else if (name == "reference") {
      peers.reference = true;
    } else if (name != "none") {
      throw UsageError("--peers: '" + name + "' is none of vtk, embree, reference and none");
    }
  }
  if ((peers.vtk || peers.embree) && !bench::peers_are_built()) {
    throw UsageError(
        "--peers: VTK and Embree are not built in: 'scripts/fathom bench' installs "
        "them and builds with them (-DFATHOM_PEERS=ON)");
  }
  return peers;
}

std::vector<std::string> parse_scenes(const std::string& list) {
  if (list.empty()) return bench::default_scene_names();
  std::vector<std::string> names = split_list(list);
  for (const std::string& name : names) {
    const bool is_file = name.find_first_of("./") != std::string::npos;
    if (!bench::is_made_scene(name) && !is_file) {
      throw UsageError(
          fmt::format("--scene: there is no scene '{}'; there are {}, room-outside, "
                      "sphere-N and mesh files",
                      name, fmt::join(bench::default_scene_names(), ", ")));
    }
  }
  return names;
}

std::vector<int> parse_threads(const std::string& list) {
  const int all = bench::processor_count();
  if (list.empty()) return {all};
  std::vector<int> counts;
  for (const std::string& text : split_list(list)) {
    const std::uint32_t count = parse_count("--threads", text);
    if (count > static_cast<std::uint32_t>(all)) {
      throw UsageError(
          fmt::format("--threads: {} is more than the {} processors that there are", count, all));
    }
    counts.push_back(count == 0 ? all : static_cast<int>(count));
  }
  return counts;
}

/// Every scene at every size with every number of threads.
std::vector<Plan> plans_of(const BenchArguments& arguments) {
  std::vector<Plan> plans;
  const auto channels = parse_channels(arguments.channels);
  const auto repeat = static_cast<int>(
      std::min(parse_count("--repeat", arguments.repeat, 1), std::uint32_t{1'000'000}));
  for (const std::string& size : split_list(arguments.sizes)) {
    const auto [width, height] = parse_size("--size", size);
    for (const int threads : parse_threads(arguments.threads)) {
      for (const std::string& scene : parse_scenes(arguments.scenes)) {
        plans.push_back({scene, width, height, threads, repeat, channels});
      }
    }
  }
  return plans;
}

std::uint64_t count_triangles(const Plan& plan) {
  return std::stoull(bench::run_in_child([&] {
    return std::to_string(
        triangle_count(bench::make_scene(plan.scene, plan.width, plan.height).scene));
  }));
}

std::vector<std::string> renderers_for(const Peers& peers, std::uint64_t triangles) {
  std::vector<std::string> renderers{"fast"};
  if (peers.vtk) renderers.emplace_back("vtk");
  if (peers.embree) renderers.insert(renderers.end(), {"embree", "embree-robust"});
  if (peers.reference && !(peers.by_default && triangles > bearable_triangles)) {
    renderers.emplace_back("reference");
  }
  return renderers;
}

/// A renderer that covers other pixels than fast by more than a hundredth draws something else.
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

Comparison compare(const Plan& plan, const Peers& peers, const Console& console,
                   const std::function<void(double)>& progress) {
  Comparison comparison{plan, count_triangles(plan), {}};
  const std::vector<std::string> renderers = renderers_for(peers, comparison.triangles);
  for (std::size_t i = 0; i < renderers.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(renderers.size()));
    const std::string text =
        bench::run_in_child([&] { return to_text(bench::measure(renderers[i], plan)); });
    for (Measurement& m : bench::measurements_from_text(text)) {
      comparison.measurements.push_back(std::move(m));
    }
  }
  warn_of_other_pictures(comparison, console);
  return comparison;
}

std::string machine_line(const bench::Machine& machine) {
  return fmt::format("{}, {} processor{}, {:.1f} GiB; {}; {}\n\n", machine.processor,
                     machine.processors, machine.processors == 1 ? "" : "s",
                     static_cast<double>(machine.memory_bytes) / (1 << 30), machine.system,
                     machine.compiler);
}

/// "vtk: VTK 9.1.0 on llvmpipe", a line for each renderer that says what it is.
std::string version_lines(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> lines;
  for (const Comparison& comparison : comparisons) {
    for (const Measurement& m : comparison.measurements) {
      if (!m.description.empty()) lines.push_back(m.renderer + ": " + m.description + "\n");
    }
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return fmt::format("{}", fmt::join(lines, ""));
}

int run_bench(const BenchArguments& arguments, const Console& console) {
  const Peers peers = parse_peers(arguments.peers);
  const std::vector<Plan> plans = plans_of(arguments);
  std::optional<OutputFile> json;
  if (!arguments.json.empty() && arguments.json != "-") json.emplace(arguments.json);
  if (peers.by_default && !bench::peers_are_built()) {
    console.warn(
        "VTK and Embree are not built in: 'scripts/fathom bench' installs them and builds "
        "with them");
  }

  const bool shows_table = arguments.json != "-";
  const bench::Machine machine = bench::this_machine();
  if (shows_table) print(machine_line(machine));
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    {
      Progress progress(console, plans[i].scene);
      comparisons.push_back(compare(plans[i], peers, console, progress.reporter(i, plans.size())));
    }
    if (shows_table) print(bench::table(comparisons.back()));
  }
  if (shows_table) print(version_lines(comparisons));
  const std::string report = bench::to_json(machine, comparisons) + "\n";
  if (!shows_table) print(report);
  if (json) {
    json->write(report);
    json->commit();
  }
  return done;
}

void add_bench(Program& program) {
  CLI::App* command = program.add_command(
      "bench", "Time and memory beside VTK, Embree and the reference engine",
      "  fathom bench\n"
      "  fathom bench --scene sphere-200k,soup --threads 1,2 --json times.json\n"
      "  fathom bench --scene sphere-5k --peers reference --size 640x360\n"
      "\nScenes: sphere-20k, sphere-200k, sphere-2m, mesh, soup, few-large, grid-aligned,\n"
      "grid-shifted and room (default: these), room-outside, sphere-N for any N, mesh files.\n"
      "Each renderer runs in a process of its own on as many processors as there are threads;\n"
      "its first frame is not counted. Times of vtk are without read-back, those of embree\n"
      "without embree-build.");
  const auto arguments = std::make_shared<BenchArguments>();
  command->add_option("--scene", arguments->scenes, "Scenes to render (default: see below)");
  command->add_option("--size", arguments->sizes, "Image sizes (default 1920x1080)");
  command->add_option("--threads", arguments->threads,
                      "Numbers of threads (default: all processors)");
  command->add_option("--peers", arguments->peers,
                      "Renderers beside fast: vtk, embree, reference or none (default: all, the "
                      "reference engine up to 20000 triangles)");
  command->add_option("--channels", arguments->channels,
                      "Channels that our engines compute (default Z)");
  command->add_option("--repeat", arguments->repeat,
                      "Frames to time, within 20 seconds (default 9)");
  command->add_option("--json", arguments->json, "Also write the figures as JSON; - for only them");
  command->callback([&program, arguments] {
    program.run = [&program, arguments] { return run_bench(*arguments, program.console); };
  });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "bench", fathom::app::add_bench);
}
