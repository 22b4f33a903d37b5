#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/map_arguments.h"
#include "apps/shell/console.h"
#include "apps/shell/elapsed_time.h"
#include "apps/validate/validate_arguments.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using attribution::OtherMap;
using validation::ValidationCase;

/// The map of --map. If the map lacks information for reading it, the message names the option.
OtherMap other_map_of(DepthMap map, const ValidateArguments& arguments) {
  if (arguments.png_scale) {
    const bool has_codes =
        std::any_of(map.channels.begin(), map.channels.end(), [](const ImageChannel& channel) {
          return std::holds_alternative<Samples<std::uint16_t>>(channel.values);
        });
    if (!has_codes) throw UsageError("--png-scale: " + arguments.map + " holds no 16-bit integers");
    map.png_scale = arguments.png_scale;
  }
  try {
    return attribution::other_map(map, arguments.channel);
  } catch (const InputError& error) {
    const std::string& setting = error.setting();
    if (setting.empty()) {
      const char* option = arguments.channel.empty() ? ": --channel NAME" : "";
      throw InputError(fmt::format("{}: {}{}", arguments.map, error.what(), option));
    }
    const std::string why = std::string(error.what()).substr(setting.size() + 2);
    throw InputError(fmt::format("{}: {}: --png-scale N", arguments.map, why));
  }
}

/// A map contains the camera that it was drawn with; where the map has a fault, that camera may be
/// another one than --camera.
void note_other_camera(const std::optional<Camera>& own, const Camera& camera,
                       const std::string& file, attribution::Attribution& found) {
  const bool has_fault =
      found.count(attribution::PixelClass::unexplained) > 0 || !found.findings.empty();
  if (!own || !has_fault) return;
  const bool is_same = own->width == camera.width && own->height == camera.height &&
                       own->projection == camera.projection &&
                       own->world_to_camera == camera.world_to_camera;
  if (is_same) return;
  found.notes.push_back({.kind = "camera",
                         .text = "the map contains another camera than --camera; with '--camera " +
                                 file + "' it is judged by its own",
                         .pixels = found.classes.size()});
}

ValidationCase judge_brought(const ValidateArguments& arguments, const Console& console) {
  const Camera camera = camera_of_comparison(arguments, arguments.map, console);
  // Faults of the arguments are reported before the files are read.
  const std::string name = arguments.model.empty() ? any_model : arguments.model;
  if (name == matching) {
    throw UsageError(
        "--model matching: judges each renderer of --against by its own model; expected a model "
        "of the map's renderer, or auto");
  }
  std::optional<attribution::RendererModel> model;
  if (name != any_model) model = attribution::model_for(name, camera);
  DepthMap map = read_map_argument(arguments.map);
  const std::optional<Camera> own = camera_of(map, arguments.map);
  const OtherMap other = other_map_of(std::move(map), arguments);
  const Scene scene = read_files(arguments.scenes, arguments.limits, console);
  ValidationCase made{.scene = std::filesystem::path(arguments.scenes.front()).stem(),
                      .renderer = "map",
                      .variant = name,
                      .file = arguments.map};
  const ElapsedTime elapsed(console, "judging");
  attribution::Judgement judged =
      attribution::judge_map(arguments.map, other, scene, camera, model);
  note_other_camera(own, camera, arguments.map, judged.attribution);
  set_judgement(made, std::move(judged));
  return made;
}

}  // namespace

int validate_map(const ValidateArguments& arguments, const Console& console) {
  ValidationReport report(arguments);
  Stopwatch watch;
  std::vector<ValidationCase> cases{judge_brought(arguments, console)};
  cases.front().seconds = watch.lap();
  return report.finish(cases, console);
}

}  // namespace fathom::app
