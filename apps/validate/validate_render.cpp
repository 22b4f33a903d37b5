#include <filesystem>
#include <utility>

#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/validate/validate_input.h"
#include "apps/validate/validate_modes.h"
#include "fathom/attribution/other_map.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "fathom/image/map_texts.h"
#include "validation/peers/drawing.h"

namespace fathom::app {
namespace {

using validation::Peer;

/// The renderer of --render in the requested variant, else in its first variant.
Peer peer_to_render(const ValidateArguments& arguments) {
  const auto renderer =
      about_option("--render", [&] { return validation::renderer_named(arguments.render); });
  if (arguments.variants.empty()) {
    return validation::peers_of(renderer, arguments.time_limit()).front();
  }
  return about_option("--variants",
                      [&] { return validation::peer_named(renderer, arguments.variants); });
}

}  // namespace

int validate_render(const ValidateArguments& arguments, const Console& console) {
  if (arguments.output.empty()) throw UsageError("-o MAP is missing: where the map goes");
  const auto format = map_format_of(arguments.output);
  if (!format)
    throw UsageError("-o: '" + arguments.output + "' does not end in " + suffixes_of_float_maps());
  if (arguments.scenes.empty()) throw UsageError("SCENE is missing: the scene to render");
  const SceneToMake scene = scenes_of(arguments, console).front();
  const Peer peer = peer_to_render(arguments);
  OutputFile output(arguments.output);
  validation::Drawing drawing = validation::draw_in_child(peer, scene.make, arguments.time_limit());
  if (!drawing.drawn) throw InputError(drawing.failure);
  DepthMap map = attribution::as_depth_map(drawing.drawn->map);
  const Camera camera = scene.make().camera;
  map.texts[camera_text] = to_json(camera, Digits::seventeen);
  map.texts[engine_text] = drawing.drawn->version;
  output.write([&](const std::filesystem::path& path) {
    write_map(map, path, *format,
              {.channel = holds_all_channels(*format) ? "" : "Z", .camera = camera});
  });
  output.commit();
  return done;
}

}  // namespace fathom::app
