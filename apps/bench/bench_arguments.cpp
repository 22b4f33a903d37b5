#include "apps/bench/bench_arguments.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/bench/parts/ideas.h"
#include "apps/options/map_arguments.h"
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

std::vector<std::string> parse_scenes(const std::string& list) {
  std::vector<std::string> names = parse_list(list);
  for (const std::string& name : names) {
    const bool is_file = name.find_first_of("./") != std::string::npos;
    if (!bench::is_made_scene(name) && !is_file) {
      std::vector<std::string> existing = bench::default_scene_names();
      existing.emplace_back("room-outside");
      throw UnknownName(fmt::format("there is no scene '{}'; there are {}, sphere-N and mesh files",
                                    name, joined(existing, ", ")),
                        name, existing);
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

}  // namespace fathom::app
