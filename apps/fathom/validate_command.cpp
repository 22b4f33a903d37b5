// fathom validate: another renderer's map held against the exact one, every difference attributed.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "fathom/image/map_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"
#include "known_files.h"
#include "output_file.h"
#include "program_main.h"
#include "validate_report.h"
#include "validation/attribution/hypotheses.h"

namespace fathom::app {
namespace {

using validation::RendererModel;
using validation::Truth;
using validation::ValidationCase;

struct ValidateArguments {
  std::vector<std::string> scenes;
  std::string map, camera, model, channel, out, baseline;
};

Camera read_camera(const std::string& file) {
  if (file.empty())
    throw UsageError("--camera FILE is missing: the camera that the map was made with");
  note_input(file);
  const std::vector<Camera> cameras = read_cameras(file);
  if (cameras.size() != 1) {
    throw UsageError(file + ": is a camera path; expected a single camera");
  }
  return cameras.front();
}

Scene read_files(const std::vector<std::string>& files, const Console& console) {
  if (files.empty()) throw UsageError("SCENE is missing: what the map shows");
  for (const std::string& file : files) note_input(file);
  Warnings warnings;
  Scene scene = read_scene({files.begin(), files.end()}, {.hash = false}, warnings);
  console.warn(warnings);
  return scene;
}

void require_clip_planes(const RendererModel& model, const Camera& camera) {
  if (model.kind == RendererModel::Kind::ray) return;
  const bool perspective = camera.projection == Projection::perspective;
  if (camera.far < std::numeric_limits<double>::infinity() && (camera.near > 0 || !perspective))
    return;
  throw UsageError("--model " + model.name +
                   ": the camera file has no near and far, between which its depths are stored");
}

ValidationCase validate_map(const ValidateArguments& arguments, const Console& console) {
  ValidationCase made{.renderer = "map", .variant = arguments.model, .version = arguments.map};
  made.model = validation::model_named(arguments.model);
  const Camera camera = read_camera(arguments.camera);
  require_clip_planes(made.model, camera);
  note_input(arguments.map);
  made.other = validation::other_map(read_map(arguments.map), arguments.channel);
  if (made.other.width != camera.width || made.other.height != camera.height) {
    throw InputError(fmt::format("{}: has {}x{} pixels, the camera {}x{}", arguments.map,
                                 made.other.width, made.other.height, camera.width, camera.height));
  }
  const Scene scene = read_files(arguments.scenes, console);
  made.scene = std::filesystem::path(arguments.scenes.front()).stem();
  const auto truth = std::make_shared<Truth>(validation::make_truth(scene, camera));
  for (const std::uint32_t triangle : made.other.triangles) {
    if (triangle != no_surface && triangle >= truth->mesh.triangles.size()) {
      throw InputError(fmt::format("{}: shows triangle {}, but the scene has {}", arguments.map,
                                   triangle, truth->mesh.triangles.size()));
    }
  }
  made.attribution = validation::attribute_and_name(*truth, made.other, made.model);
  made.truth = truth;
  return made;
}

int run_validate(const ValidateArguments& arguments, const Console& console) {
  if (arguments.map.empty())
    throw UsageError("--map MAP is missing: the map to hold against the truth");
  if (arguments.model.empty()) {
    throw UsageError("--model is missing: there are " + validation::model_names());
  }
  const std::vector<ValidationCase> cases{validate_map(arguments, console)};
  return report_cases(cases, {arguments.out, arguments.baseline});
}

void add_validate(Program& program) {
  CLI::App* command = program.add_command(
      "validate", "Hold another renderer's maps against the truth, every difference explained",
      "  fathom validate --map other.exr --camera camera.json --model gl-unorm24 spot.obj --out "
      "report\n"
      "\nModels: " +
          validation::model_names() +
          ".\nExit status 1 where a pixel is unexplained or a fault was found; see "
          "docs/validation.md.");
  const auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("SCENE", arguments->scenes, "Meshes and scene files");
  command->add_option("--map", arguments->map, "The map of another renderer (EXR, PFM, PNG, NPY)");
  command->add_option("--channel", arguments->channel, "Its channel of depths (default: detected)");
  command->add_option("--camera", arguments->camera, "Camera file that the map was made with");
  command->add_option("--model", arguments->model, "What is assumed of the renderer");
  command->add_option("--out", arguments->out, "Folder for report.json");
  command->add_option("--baseline", arguments->baseline,
                      "An earlier report.json: exit status 1 if something got worse");
  command->callback([&program, arguments] {
    program.run = [&program, arguments] { return run_validate(*arguments, program.console); };
  });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "validate", fathom::app::add_validate);
}
