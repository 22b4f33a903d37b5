#include "apps/bench/mpi_bench_arguments.h"

#include "apps/options/map_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"

namespace fathom::app {
namespace {

bench::GeneratedKind parse_kind(const std::string& text) {
  using bench::GeneratedKind;
  return parse_word<GeneratedKind>(
      text, {{"terrain", GeneratedKind::terrain}, {"soup", GeneratedKind::soup}});
}

}  // namespace

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

}  // namespace fathom::app
