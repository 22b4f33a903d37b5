// Times `fathom-mpi render` on scenes of any size, which the ranks make instead of reading them:
//   mpirun -n 2 build/…/bin/fathom_mpi_bench --scene terrain --triangles 1000000 -o map.exr
// Prints a line of JSON. Its processor_seconds and peak_memory are the maxima over all ranks.

#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/render_together.h"
#include "apps/mpi/together.h"
#include "apps/options/map_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/text/parse_json.h"
#include "validation/scenes/generated/generated_scene.h"

namespace fathom::app {
namespace {

/// The arguments of fathom_mpi_bench: the scene to make, and the arguments of `fathom-mpi render`
/// that affect its cost.
struct MpiBenchArguments {
  bench::GeneratedArguments scene;
  Size size{1920, 1080};
  MpiArguments rendering;

  MpiBenchArguments();
  void add_to(Command& command);
};

bench::GeneratedKind parse_kind(const std::string& text) {
  using bench::GeneratedKind;
  return parse_word<GeneratedKind>(
      text, {{"terrain", GeneratedKind::terrain}, {"soup", GeneratedKind::soup}});
}

MpiBenchArguments::MpiBenchArguments() {
  rendering.render.channels = {Channel::Z};
  rendering.render.scene.threads = 1;
}

void MpiBenchArguments::add_to(Command& command) {
  RenderArguments& render = rendering.render;
  command.option(
      "--scene", "NAME", into(scene.kind, parse_kind),
      "Scene: terrain (default; neighbouring triangles follow each other) or soup (random order)");
  command.option("--triangles", "N", into(scene.triangles, parse_positive),
                 "Number of triangles (default 1000000)");
  command.option("--edge", "LENGTH", into(scene.edge, parse_scale),
                 "Triangle size for the soup scene, which fills a unit cube (default 2 / √N)");
  command.option("--size", "WxH", into(size, parse_size), "Image size (default 1920x1080)");
  command.option("--channels", "LIST", into(render.channels, parse_channels),
                 "Channels of the map (default Z)");
  command.option("--partition", "NAME", into(rendering.partition, parse_partition),
                 "Distribute the tiles by load (default), rows or round-robin");
  command.option("--memory", "SIZE", into(rendering.memory, parse_bytes),
                 "Maximum memory of a rank for its triangles; see 'fathom-mpi render --help'");
  command.option("--threads", "N", into(render.scene.threads, parse_thread_count),
                 "Threads per rank (default 1)");
  command.option("--traffic", "FILE", rendering.traffic,
                 "Write the report of 'fathom-mpi render --traffic' to this file");
  add_output_option(command, "FILE", render.output, "The map").required();
}

using Json = nlohmann::ordered_json;

/// Whether this rank has come as far as others wait for it.
bool work_has_begun = false;

/// The resources that this process has used until now.
struct Taken {
  std::uint64_t microseconds;  ///< of processors, also those that a rank spends waiting for others
  std::uint64_t memory;        ///< the most that it has had in RAM at a time, in bytes
};

Taken taken() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto microseconds = [](const timeval& time) {
    return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000 +
           static_cast<std::uint64_t>(time.tv_usec);
  };
  return {microseconds(usage.ru_utime) + microseconds(usage.ru_stime),
          static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

/// The traffic of triangles, pixels and chunks, and its sum, from the file that the ranks wrote.
Json sent(const std::string& traffic_file) {
  std::ifstream file(traffic_file);
  std::string line;
  if (!std::getline(file, line)) throw InputError(traffic_file + ": cannot be read");
  Json told;
  text::parse_json(line, told);
  Json sent = told["sent"];
  std::uint64_t messages = 0, bytes = 0;
  for (const Json& kind : sent) {
    messages += kind["messages"].get<std::uint64_t>();
    bytes += kind["bytes"].get<std::uint64_t>();
  }
  sent["all"] = {{"messages", messages}, {"bytes", bytes}};
  return sent;
}

int run(MpiBenchArguments arguments, const Console& console) {
  const Ranks ranks;
  work_has_begun = true;
  MpiArguments& rendering = arguments.rendering;
  const bool keeps_traffic = !rendering.traffic.empty();
  if (!keeps_traffic) rendering.traffic = rendering.render.output + ".traffic";
  std::optional<SharedScene> scene;
  std::vector<Camera> cameras;
  together(ranks, [&] {
    if (rendering.traffic == "-") throw UsageError("--traffic: expected a file, not '-'");
    scene.emplace(bench::generated_scene(arguments.scene));
    const auto [width, height] = arguments.size;
    cameras.push_back(bench::camera_of(arguments.scene.kind, {width, height}));
  });

  const std::uint64_t before = taken().microseconds;
  Stopwatch stopwatch;
  const int status = render_scene_together(rendering, *scene, cameras, console);
  const double seconds = stopwatch.lap();
  const std::uint64_t processor = ranks.greatest(taken().microseconds - before);
  const std::uint64_t memory = ranks.greatest(taken().memory);
  if (status != done || !ranks.is_first()) return status;
  const Json line{{"scene", bench::name_of(arguments.scene.kind)},
                  {"triangles", arguments.scene.triangles},
                  {"size", arguments.size},
                  {"ranks", ranks.count()},
                  {"threads", rendering.render.scene.threads},
                  {"seconds", seconds},
                  {"processor_seconds", static_cast<double>(processor) * 1e-6},
                  {"peak_memory", memory},
                  {"sent", sent(rendering.traffic)}};
  print(json_answer(line, -1));
  if (!keeps_traffic) std::filesystem::remove(rendering.traffic);
  return status;
}

void add_measuring(Command& program) {
  const auto arguments = std::make_shared<MpiBenchArguments>();
  Command& command = program.command(
      "measure", "Time the ranks of an MPI run on a generated scene",
      "  mpirun -n 2 fathom_mpi_bench --scene soup --triangles 1000000 -o map.exr\n");
  arguments->add_to(command);
  command.runs([arguments](const Console& console) { return run(*arguments, console); });
}

}  // namespace

}  // namespace fathom::app

int main(int argc, char** argv) {
  using namespace fathom::app;
  const MpiSession session(argc, argv);
  const Ranks ranks;
  report_only(ranks.is_first() ? Reports::everything : Reports::nothing);
  const int status = companion_main(argc, argv, "measure", add_measuring);
  if (work_has_begun && status != done && !failed_together()) ranks.abort(status);
  return status;
}
