#include "apps/validate/validate_arguments.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/options/camera_options.h"
#include "apps/shell/command.h"
#include "apps/shell/known_files.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/map_formats.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "validation/lenses/lens_judge.h"
#include "validation/rays/ray_engines.h"
#include "validation/scenes/validation_scenes.h"
#include "validation/variants/peer.h"

namespace fathom::app {

namespace {

/// Stores a list of names after checking each name.
TakeText names_into(std::string& list, void (*check)(const std::string&)) {
  return [&list, check](const std::string& text) {
    parse_names(text, check);
    list = text;
  };
}

void expect_renderer(const std::string& name) {
  validation::renderer_named(name);
}

void expect_scene(const std::string& name) {
  if (validation::is_scene_name(name)) return;
  throw UnknownName(fmt::format("there is no scene '{}'; there are {}", name,
                                fmt::join(validation::scene_names(), ", ")),
                    name, validation::scene_names());
}

void expect_ray_engine(const std::string& name) {
  validation::ray_engine_named(name);
}

void expect_lens_engine(const std::string& name) {
  std::vector<std::string> names = validation::ray_engine_names();
  names.emplace_back(validation::cycles_engine);
  if (std::ranges::find(names, name) != names.end()) return;
  throw UnknownName(
      fmt::format("there is no engine '{}'; there are {}", name, fmt::join(names, ", ")), name,
      names);
}

std::string parse_model(const std::string& text) {
  if (text == any_model || text == matching) return text;
  const std::vector<attribution::RendererModel> models = attribution::named_models();
  if (std::ranges::find(models, text, &attribution::RendererModel::name) != models.end())
    return text;
  throw attribution::unknown_model(text, {any_model, matching});
}

std::string parse_renderer(const std::string& text) {
  validation::renderer_named(text);
  return text;
}

}  // namespace

void ValidateArguments::add_to(Command& command) {
  command.arguments("SCENE", scenes, "Meshes and scene files");
  command.option("--against", "NAME", names_into(against, expect_renderer),
                 "Draw the scenes with these renderers and check them: vtk, opengl, embree, "
                 "blender; vtk and opengl also with a driver, e.g. opengl@softpipe, vtk@llvmpipe");
  command.flag("--colour", colour,
               "Compare the pipeline's flat, Gouraud and Phong pictures with VTK's");
  command.flag(
      "--faults", faults,
      "Inject every fault of the catalogue into the renderers' maps and report which are found");
  command.option("--rays", "NAME", names_into(rays, expect_ray_engine),
                 "Trace rays through the scenes with these engines and check every hit: embree, "
                 "embree-robust, cgal");
  command.option("--lenses", "NAME", names_into(lenses, expect_lens_engine),
                 "Trace the scenes through lenses and panoramas with these engines and check every "
                 "pixel: embree, embree-robust, cgal, cycles (panoramas of Blender)");
  command.option("--count", "N", into(ray_count, parse_positive),
                 "With --rays: rays of each kind in each scene (default 16384)");
  command.option("--scene", "NAME", names_into(scene_names, expect_scene),
                 "Use these built-in scenes instead of SCENE (default: all, see below)");
  command.option("--variants", "NAME", variants,
                 "Check only these variants of the renderers, e.g. unorm24, robust (default: all); "
                 "with --lenses, these lenses, e.g. UCM,EQUIRECTANGULAR");
  limits.add_to(command);
  command.option("--size", "WxH", into(size, parse_size),
                 "Image size without --camera (default 320x240)");
  command.option("--time-limit", "SECONDS", into(seconds, parse_positive),
                 "Stop a renderer after this many seconds (default 300)");
  command.option("--render", "NAME", into(render, parse_renderer),
                 "Only draw with this renderer, and write its map");
  command.option("--map", "MAP", map,
                 "Map of another renderer to check (" + names_of_readable_maps() + ")");
  command.option("--channel", "NAME", channel, "Depth channel of --map (default: detected)");
  command.option("--png-scale", "N", into(png_scale, parse_scale),
                 "Codes per unit, if the integer map does not state them");
  command.option(
      "--camera", "FILE", camera,
      "Camera file (JSON), or a map, which contains its camera. From a path, --map takes the "
      "camera of the same name (a.jpg for a.npy). The camera of --map may have a lens");
  command.option(
      "--model", "NAME", into(model, parse_model),
      "Model of the renderer (default with --map: auto, the best fit). With --against, judge the "
      "maps like maps from a file, in binary32; matching: each by the model of its variant");
  add_output_option(command, "PATH", output,
                    "Write report.json and report.html to this folder; with --colour, colours.json "
                    "and pictures; with --rays, rays.json; with --lenses, lenses.json; with "
                    "--render, the map to this file");
  command.option(
      "--baseline", "REPORT", baseline,
      "Compare with an earlier report.json; exit status 1 only if a result became worse, "
      "or is wrong and not in the earlier report; "
      "with --output also writes comparison.html");
  command.option("--junit", "FILE", junit, "Also write a JUnit XML file for CI services");
  command.flag("--ctest", for_ctest,
               "Print the verdict of --map in the first line, with measurements and pictures for "
               "CTest and CDash; see fathom_add_depth_test in validation.md of the documentation");
}

int ValidateArguments::time_limit() const {
  return static_cast<int>(std::min(seconds, 86400U));
}

namespace {

using validation::ValidationScene;

/// The scene of the command line, with near and far.
ValidationScene named_by_files(const ValidateArguments& arguments, const Console& console) {
  Scene scene = read_files(arguments.scenes, arguments.limits, console);
  Camera camera;
  if (arguments.camera.empty()) {
    const auto [width, height] = arguments.size;
    camera = frame_scene(scene, {}, {.width = width, .height = height});
  } else {
    camera = camera_of_comparison(arguments, "", console);
    require_straight(camera,
                     "these renderers draw the images of pinhole cameras; --map judges a "
                     "map of a lens");
  }
  camera = validation::with_clip_planes(scene, camera);
  return {std::filesystem::path(arguments.scenes.front()).stem(), std::move(scene), camera};
}

}  // namespace

Camera camera_of_comparison(const ValidateArguments& arguments, const std::string& map,
                            const Console& console) {
  const std::string& file = arguments.camera;
  if (file.empty()) {
    throw UsageError(
        fmt::format("--camera FILE is missing; if the map contains its camera: --camera {}", map));
  }
  const std::vector<Camera> cameras = read_cameras_with_lenses(file, arguments.limits, console);
  if (cameras.size() > 1 && !map.empty()) return camera_called_as(map, cameras);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format(
        "{}: is a path of {} cameras; expected a single one, as 'fathom camera import … --image "
        "NAME' writes it, or a map that contains its camera",
        file, cameras.size()));
  }
  return cameras.front();
}

Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console) {
  if (files.empty()) throw UsageError("SCENE is missing: the scene that the map shows");
  for (const std::string& file : files) note_input(file);
  Warnings warnings;
  ReadOptions options = limits.read_options();
  options.hash = false;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  return scene;
}

std::vector<SceneToMake> scenes_of(const ValidateArguments& arguments, const Console& console) {
  if (!arguments.scenes.empty()) {
    for (const std::string& file : arguments.scenes) note_input(file);
    const std::string name = std::filesystem::path(arguments.scenes.front()).stem();
    return {{name, [&arguments, &console] { return named_by_files(arguments, console); }}};
  }
  const auto [width, height] = arguments.size;
  std::vector<SceneToMake> scenes;
  const std::vector<std::string> names =
      arguments.scene_names.empty() ? validation::scene_names() : parse_list(arguments.scene_names);
  scenes.reserve(names.size());
  for (const std::string& name : names) {
    scenes.push_back({name, [name, w = width, h = height] {
                        return validation::make_validation_scene(name, w, h);
                      }});
  }
  return scenes;
}

}  // namespace fathom::app
