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
#include "apps/validate/validate_input.h"
#include "apps/validate/validate_modes.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using attribution::OtherMap;
using validation::ValidationCase;

/// The map of --map. If the map lacks information for reading it, the message names the option.
OtherMap read_other_map(const ValidateArguments& arguments) {
  DepthMap map = read_map_argument(arguments.map);
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

ValidationCase judge_brought(const ValidateArguments& arguments, const Console& console) {
  const Camera camera = read_camera(arguments.camera, console);
  // Faults of the arguments are reported before the files are read.
  const std::string name = arguments.model.empty() ? any_model : arguments.model;
  std::optional<attribution::RendererModel> model;
  if (name != any_model) model = attribution::model_for(name, camera);
  const OtherMap other = read_other_map(arguments);
  const Scene scene = read_files(arguments.scenes, arguments.limits, console);
  ValidationCase made{.scene = std::filesystem::path(arguments.scenes.front()).stem(),
                      .renderer = "map",
                      .variant = name,
                      .file = arguments.map};
  const ElapsedTime elapsed(console, "judging");
  set_judgement(made, attribution::judge_map(arguments.map, other, scene, camera, model));
  return made;
}

}  // namespace

int validate_map(const ValidateArguments& arguments, const Console& console) {
  ValidationReport report(arguments);
  Stopwatch watch;
  std::vector<ValidationCase> cases{judge_brought(arguments, console)};
  cases.front().seconds = watch.lap();
  return report.finish(cases);
}

}  // namespace fathom::app
