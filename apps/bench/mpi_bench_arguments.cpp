#include "apps/bench/mpi_bench_arguments.h"

#include "apps/options/channel_list.h"
#include "apps/options/scene_options.h"
#include "apps/shell/output_option.h"

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
  command.option("--scene", "NAME", into(scene.kind, parse_kind),
                 "terrain (default: neighbours follow each other) or soup (nothing does)");
  command.option("--triangles", "N", into(scene.triangles, parse_positive),
                 "How many (default 1000000)");
  command.option(
      "--edge", "LENGTH", into(scene.edge, parse_scale),
      "Of the soup, which fills a cube of 1: the size of its triangles (default 2 / √N)");
  command.option("--size", "WxH", into(size, parse_size), "Of the image (default 1920x1080)");
  command.option("--channels", "LIST", into(render.channels, parse_channels),
                 "Those of the map (default Z)");
  command.option("--partition", "NAME", into(rendering.partition, parse_partition),
                 "How tiles are dealt out: load (default), rows or round-robin");
  command.option("--memory", "SIZE", into(rendering.memory, parse_bytes),
                 "What a rank may take for its triangles, as 'fathom-mpi render' says");
  command.option("--threads", "N", into(render.scene.threads, parse_thread_count),
                 "Of each rank (default 1)");
  command.option("--traffic", "FILE", rendering.traffic,
                 "Keep what 'fathom-mpi render --traffic' tells");
  add_output_option(command, "FILE", render.output, "The map").required();
}

}  // namespace fathom::app
