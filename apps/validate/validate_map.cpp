#include "apps/validate/validate_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <variant>
#include <vector>

#include "apps/options/map_argument.h"
#include "apps/shell/about_option.h"
#include "apps/shell/stopwatch.h"
#include "apps/validate/other_scene.h"
#include "apps/validate/validate_input.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using attribution::OtherMap;
using attribution::RendererModel;
using attribution::Truth;
using validation::ValidationCase;

void require_clip_planes(const RendererModel& model, const Camera& camera) {
  if (std::holds_alternative<attribution::RayModel>(model.kind)) return;
  const bool perspective = camera.projection == Projection::perspective;
  if (camera.far < std::numeric_limits<double>::infinity() && (camera.near > 0 || !perspective))
    return;
  throw UsageError("--model " + model.name +
                   ": the camera file has no near and far, between which its depths are stored; "
                   "expected those of the renderer in it, as \"near\": 0.1, \"far\": 100");
}

/// The map of --map. Where it does not say what is needed to read it, the message does.
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
      throw InputError(fmt::format("{}: {}: --channel NAME", arguments.map, error.what()));
    }
    const std::string why = std::string(error.what()).substr(setting.size() + 2);
    throw InputError(fmt::format("{}: {}: --png-scale N", arguments.map, why));
  }
}

ValidationCase judge_map(const ValidateArguments& arguments, const Console& console) {
  ValidationCase made{.renderer = "map", .variant = arguments.model, .version = arguments.map};
  made.model = about_option("--model", [&] { return attribution::model_named(arguments.model); });
  const Camera camera = read_camera(arguments.camera);
  require_clip_planes(made.model, camera);
  made.other = read_other_map(arguments);
  if (made.other.width != camera.width || made.other.height != camera.height) {
    throw InputError(fmt::format(
        "{}: has {}x{} pixels, the camera {}x{}; expected the camera that it was drawn with",
        arguments.map, made.other.width, made.other.height, camera.width, camera.height));
  }
  const Scene scene = read_files(arguments.scenes, arguments.limits, console);
  made.scene = std::filesystem::path(arguments.scenes.front()).stem();
  const auto truth = std::make_shared<Truth>(attribution::make_truth(scene, camera));
  for (const std::uint32_t triangle : made.other.triangles) {
    if (triangle != no_surface && triangle >= truth->mesh.triangles.size()) {
      throw InputError(fmt::format(
          "{}: shows triangle {}, but the scene has {}; expected the SCENE that it was drawn from",
          arguments.map, triangle, truth->mesh.triangles.size()));
    }
  }
  made.attribution = attribution::attribute_and_name(*truth, made.other, made.model);
  made.truth = truth;
  name_other_scene(made);
  return made;
}

}  // namespace

int validate_map(const ValidateArguments& arguments, const Console& console) {
  if (arguments.model.empty()) {
    throw UsageError("--model is missing: there are " + attribution::model_names());
  }
  ValidationReport report(arguments);
  Stopwatch watch;
  std::vector<ValidationCase> cases{judge_map(arguments, console)};
  cases.front().seconds = watch.lap();
  return report.finish(cases);
}

}  // namespace fathom::app
