#include "apps/validate/validate_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/map_argument.h"
#include "apps/shell/stopwatch.h"
#include "apps/validate/judge_brought.h"
#include "apps/validate/other_scene.h"
#include "apps/validate/validate_input.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/other_size.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using attribution::OtherMap;
using attribution::Truth;
using validation::ValidationCase;

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

void require_known_triangles(const ValidateArguments& arguments, const OtherMap& other,
                             const Scene& scene) {
  const std::uint64_t count = triangle_count(scene);
  for (const std::uint32_t triangle : other.triangles) {
    if (triangle == no_surface || triangle < count) continue;
    throw InputError(fmt::format(
        "{}: shows triangle {}, but the scene has {}; expected the SCENE that it was drawn from",
        arguments.map, triangle, count));
  }
}

/// A map of another size is judged as what explains it best, if that explains half of it.
void judge_other_size(const ValidateArguments& arguments, const Camera& camera, const Scene& scene,
                      ValidationCase& made) {
  const std::string size =
      fmt::format("{}: has {}x{} pixels, the camera {}x{}", arguments.map, made.other.width,
                  made.other.height, camera.width, camera.height);
  std::optional<ValidationCase> best;
  const auto unexplained = [](const ValidationCase& c) {
    return c.attribution.count(attribution::PixelClass::unexplained);
  };
  for (const attribution::SizedMap& sized :
       attribution::readings_of_other_size(camera, made.other)) {
    ValidationCase next = made;
    next.truth = std::make_shared<Truth>(attribution::make_truth(scene, sized.camera));
    next.other = sized.map;
    judge_brought(arguments.model, next);
    attribution::Finding finding = sized.finding;
    finding.pixels = next.attribution.classes.size();
    next.attribution.findings.insert(next.attribution.findings.begin(), std::move(finding));
    if (!best || unexplained(next) < unexplained(*best)) best = std::move(next);
  }
  if (!best || unexplained(*best) * 2 > best->attribution.classes.size()) {
    throw InputError(size + "; expected the camera that it was drawn with");
  }
  made = std::move(*best);
}

ValidationCase judge_map(const ValidateArguments& arguments, const Console& console) {
  ValidationCase made{.renderer = "map", .variant = arguments.model, .version = arguments.map};
  const Camera camera = read_camera(arguments.camera, console);
  // What is wrong with it is said before the files are read.
  if (arguments.model != any_model) made.model = model_for(arguments.model, camera);
  made.other = read_other_map(arguments);
  const Scene scene = read_files(arguments.scenes, arguments.limits, console);
  made.scene = std::filesystem::path(arguments.scenes.front()).stem();
  require_known_triangles(arguments, made.other, scene);
  if (made.other.width != camera.width || made.other.height != camera.height) {
    judge_other_size(arguments, camera, scene, made);
  } else {
    made.truth = std::make_shared<Truth>(attribution::make_truth(scene, camera));
    judge_brought(arguments.model, made);
  }
  name_other_scene(made);
  return made;
}

}  // namespace

int validate_map(const ValidateArguments& arguments, const Console& console) {
  if (arguments.model.empty()) {
    throw UsageError("--model is missing: there are " + attribution::model_names() +
                     ", and auto for the one that fits best");
  }
  ValidationReport report(arguments);
  Stopwatch watch;
  std::vector<ValidationCase> cases{judge_map(arguments, console)};
  cases.front().seconds = watch.lap();
  return report.finish(cases);
}

}  // namespace fathom::app
