// fathom preview MAP -o PNG

#include <memory>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/image/map_files.h"
#include "fathom/image/preview.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

struct PreviewArguments {
  std::string map, output, channel, colours = "viridis", range, unit;
};

int run_preview(const PreviewArguments& arguments) {
  PreviewOptions options;
  options.channel = arguments.channel;
  options.unit = arguments.unit;
  const std::optional<ColourMap> colours = colour_map_named(arguments.colours);
  if (!colours) {
    throw UsageError("--colormap: '" + arguments.colours +
                     "' is none of viridis, magma, turbo and grey");
  }
  options.colours = *colours;
  if (!arguments.range.empty()) {
    const auto [low, high] = parse_pair("--range", arguments.range);
    options.low = low;
    options.high = high;
  }
  expect_png("--output", arguments.output);
  note_input(arguments.map);
  const DepthMap map = read_map(arguments.map);
  const RgbImage picture = draw_preview(map, options);
  OutputFile output(arguments.output);
  output.write([&](const auto& path) { write_png(picture, path); });
  output.commit();
  return done;
}

}  // namespace

void add_preview(Program& program) {
  const auto arguments = std::make_shared<PreviewArguments>();
  CLI::App* command = program.add_command(
      "preview", "Draw a channel of a map with a colour bar",
      "  fathom preview spot.exr -o spot.png\n"
      "  fathom preview spot.exr --channel id -o triangles.png\n"
      "  fathom preview spot.exr --colormap magma --range 2,5 --unit m -o spot.png");
  command->add_option("MAP", arguments->map, "The map: EXR, PFM, PNG or NPY")->required();
  command->add_option("-o,--output", arguments->output, "The picture (PNG, 8 bit)")->required();
  command->add_option("--channel", arguments->channel, "The channel to draw (default Z)");
  command->add_option("--colormap", arguments->colours, "viridis (default), magma, turbo or grey");
  command->add_option("--range", arguments->range,
                      "LOW,HIGH: ends of the colour bar (default: those of the map)");
  command->add_option("--unit", arguments->unit, "Written behind the channel's name");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_preview(*arguments); }; });
}

}  // namespace fathom::app
