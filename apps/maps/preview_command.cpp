// fathom preview MAP -o PNG

#include <memory>

#include "apps/commands.h"
#include "apps/options/map_arguments.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_formats.h"
#include "fathom/image/preview.h"

namespace fathom::app {
namespace {

struct PreviewArguments {
  std::string map, output;
  PreviewOptions options;
};

ColourMap parse_colour_map(const std::string& text) {
  if (const std::optional<ColourMap> colours = colour_map_named(text)) return *colours;
  refuse_word(text, names_of(all_colour_maps));
}

ColourScale parse_colour_scale(const std::string& text) {
  if (const std::optional<ColourScale> scale = colour_scale_named(text)) return *scale;
  refuse_word(text, names_of(all_colour_scales));
}

int run_preview(const PreviewArguments& arguments) {
  const DepthMap map = read_map_or_flat_map(arguments.map);
  const RgbImage picture = draw_preview(map, arguments.options);
  OutputFile output(arguments.output);
  output.write([&](const auto& path) { write_png(picture, path); });
  output.commit();
  return done;
}

}  // namespace

void add_preview(Command& program) {
  const auto arguments = std::make_shared<PreviewArguments>();
  PreviewOptions& options = arguments->options;
  Command& command = program.command(
      "preview", "Draw a channel of a map with a colour bar",
      "  fathom preview spot.exr -o spot.png\n"
      "  fathom preview spot.exr --channel id -o triangles.png\n"
      "  fathom preview deep.exr --channel samples -o samples.png\n"
      "  fathom preview spot.exr --colormap magma --range 2,5 --unit m -o spot.png\n"
      "  fathom preview room.exr --scale log -o room.png");
  command
      .argument("MAP", arguments->map,
                "Map to draw (" + names_of_readable_maps() + ", also deep EXR)")
      .required();
  add_output_option(command, "FILE", into(arguments->output, parse_png_name),
                    "Write the picture here (PNG, 8 bit)")
      .required();
  command.option("--channel", "NAME", options.channel,
                 "Channel to draw (default Z); of a deep EXR Z, ZBack, id, A or samples");
  command.option(
      "--colormap", "NAME", into(options.colours, parse_colour_map),
      "Colours: viridis (default), magma, turbo, grey or diverging (default for Zerror)");
  command.option("--scale", "NAME", into(options.scale, parse_colour_scale),
                 "How the colours spread over the range: linear (default), log, inverse or "
                 "equalised (every colour covers as many pixels)");
  command.option(
      "--range", "LOW,HIGH",
      [&options](const std::string& text) {
        const auto [low, high] = parse_pair(text);
        options.low = low;
        options.high = high;
      },
      "Ends of the colour bar, LOW,HIGH (default: least and greatest value of the map)");
  command.option("--unit", "NAME", options.unit, "Unit to show after the name of the channel");
  command.runs([arguments](const Console&) { return run_preview(*arguments); });
}

}  // namespace fathom::app
