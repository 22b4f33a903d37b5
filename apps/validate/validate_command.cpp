// fathom validate: compares another renderer's map with the exact map and attributes every
// difference.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "apps/companions.h"
#include "apps/shell/program.h"
#include "apps/validate/validate_arguments.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"
#include "validation/scenes/validation_scenes.h"

namespace fathom::app {
namespace {

int run_validate(const ValidateArguments& arguments, const Console& console) {
  const int modes =
      static_cast<int>(!arguments.map.empty()) + static_cast<int>(!arguments.against.empty()) +
      static_cast<int>(!arguments.render.empty()) + static_cast<int>(arguments.colour) +
      static_cast<int>(!arguments.rays.empty()) + static_cast<int>(!arguments.lenses.empty());
  if (modes != 1) {
    throw UsageError(
        "one of --against RENDERERS, --map MAP, --colour, --rays ENGINES, --lenses ENGINES and "
        "--render RENDERER is expected");
  }
  if (arguments.faults && arguments.against.empty()) {
    throw UsageError("--faults goes with --against RENDERERS");
  }
  if (arguments.faults && !arguments.model.empty()) {
    throw UsageError("--faults uses its own models: leave out --model");
  }
  if (arguments.for_ctest && arguments.map.empty()) throw UsageError("--ctest goes with --map");
  if (!arguments.junit.empty() && arguments.map.empty() && arguments.against.empty()) {
    throw UsageError("--junit goes with --map and --against");
  }
  if (arguments.png_scale && arguments.map.empty()) throw UsageError("--png-scale goes with --map");
  if (arguments.ray_count && arguments.rays.empty()) throw UsageError("--count goes with --rays");
  if (!arguments.lenses.empty()) return validate_lenses(arguments, console);
  if (!arguments.rays.empty()) return validate_rays(arguments, console);
  if (arguments.faults) return validate_faults(arguments, console);
  if (!arguments.against.empty()) return validate_against(arguments, console);
  if (!arguments.render.empty()) return validate_render(arguments, console);
  if (arguments.colour) return validate_colours(arguments, console);
  return validate_map(arguments, console);
}

void add_validate(Command& program) {
  Command& command = program.command(
      "validate", description_of_companion("validate"),
      "  fathom validate --against vtk,opengl,embree,blender -o report\n"
      "  fathom validate --against opengl --scene room --variants unorm16,float32\n"
      "  fathom validate --against vtk spot.obj --camera camera.json\n"
      "  fathom validate --against vtk,opengl,embree --model matching\n"
      "  fathom validate --map other.exr --camera camera.json spot.obj\n"
      "  fathom validate --map a.exr --camera camera.json --model gl-unorm24 spot.obj\n"
      "  fathom validate --against opengl -o new --baseline old/report.json\n"
      "  fathom validate --faults --against vtk --scene spot -o faults\n"
      "  fathom validate --colour --scene spot\n"
      "  fathom validate --rays embree,embree-robust,cgal -o rays\n"
      "  fathom validate --lenses embree,embree-robust -o lenses\n"
      "  fathom validate --render vtk spot.obj --camera camera.json -o vtk.exr\n"
      "\nScenes: " +
          fmt::format("{}", fmt::join(validation::scene_names(), ", ")) +
          ".\nModels: " + attribution::model_names() + "; auto; with --against, matching" +
          ".\nExit status 1 if a pixel is unexplained or a fault was found; see "
          "validation.md in the documentation.");
  const auto arguments = std::make_shared<ValidateArguments>();
  arguments->add_to(command);
  command.runs([arguments](const Console& console) { return run_validate(*arguments, console); });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "validate", fathom::app::add_validate);
}
