// fathom validate: another renderer's map held against the exact one, every difference attributed.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "apps/shell/about_option.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/progress.h"
#include "apps/shell/values.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/image/map_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "validation/peers/drawing.h"

namespace fathom::app {
namespace {

using attribution::RendererModel;
using attribution::Truth;
using validation::Peer;
using validation::ValidationCase;
using validation::ValidationScene;

struct ValidateArguments {
  std::vector<std::string> scenes;
  std::string map, camera, model, channel, out, baseline;
  std::string against, scene_names, variants, render, output;
  Size size{320, 240};
  std::uint32_t seconds = 300;
};

Camera read_camera(const std::string& file) {
  if (file.empty()) throw UsageError("--camera FILE is missing");
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
  if (std::holds_alternative<attribution::RayModel>(model.kind)) return;
  const bool perspective = camera.projection == Projection::perspective;
  if (camera.far < std::numeric_limits<double>::infinity() && (camera.near > 0 || !perspective))
    return;
  throw UsageError("--model " + model.name +
                   ": the camera file has no near and far, between which its depths are stored");
}

ValidationCase validate_map(const ValidateArguments& arguments, const Console& console) {
  ValidationCase made{.renderer = "map", .variant = arguments.model, .version = arguments.map};
  made.model = about_option("--model", [&] { return attribution::model_named(arguments.model); });
  const Camera camera = read_camera(arguments.camera);
  require_clip_planes(made.model, camera);
  note_input(arguments.map);
  made.other = attribution::other_map(read_map(arguments.map), arguments.channel);
  if (made.other.width != camera.width || made.other.height != camera.height) {
    throw InputError(fmt::format("{}: has {}x{} pixels, the camera {}x{}", arguments.map,
                                 made.other.width, made.other.height, camera.width, camera.height));
  }
  const Scene scene = read_files(arguments.scenes, console);
  made.scene = std::filesystem::path(arguments.scenes.front()).stem();
  const auto truth = std::make_shared<Truth>(attribution::make_truth(scene, camera));
  for (const std::uint32_t triangle : made.other.triangles) {
    if (triangle != no_surface && triangle >= truth->mesh.triangles.size()) {
      throw InputError(fmt::format("{}: shows triangle {}, but the scene has {}", arguments.map,
                                   triangle, truth->mesh.triangles.size()));
    }
  }
  made.attribution = attribution::attribute_and_name(*truth, made.other, made.model);
  made.truth = truth;
  return made;
}

int time_limit(const ValidateArguments& arguments) {
  return static_cast<int>(std::min(arguments.seconds, 86400U));
}

/// The scene of the command line, with near and far.
ValidationScene named_by_files(const ValidateArguments& arguments, const Console& console) {
  Scene scene = read_files(arguments.scenes, console);
  Camera camera;
  if (arguments.camera.empty()) {
    const auto [width, height] = arguments.size;
    camera = frame_scene(scene, {}, {.width = width, .height = height});
  } else {
    camera = read_camera(arguments.camera);
  }
  camera = validation::with_clip_planes(scene, camera);
  return {std::filesystem::path(arguments.scenes.front()).stem(), std::move(scene), camera};
}

/// How each scene is made: anew in every process that draws it.
struct SceneToMake {
  std::string name;
  std::function<ValidationScene()> make;
};

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
  for (const std::string& name : names) {
    if (!validation::is_scene_name(name)) {
      throw UsageError(fmt::format("--scene: there is no scene '{}'; there are {}", name,
                                   fmt::join(validation::scene_names(), ", ")));
    }
    scenes.push_back({name, [name, w = width, h = height] {
                        return validation::make_validation_scene(name, w, h);
                      }});
  }
  return scenes;
}

std::vector<Peer> peers_of(const ValidateArguments& arguments) {
  std::vector<Peer> peers;
  for (const std::string& name : parse_list(arguments.against)) {
    const auto renderer =
        about_option("--against", [&] { return validation::renderer_named(name); });
    const std::vector<Peer> more = validation::peers_of(renderer, time_limit(arguments));
    peers.insert(peers.end(), more.begin(), more.end());
  }
  if (arguments.variants.empty()) return peers;
  const std::vector<std::string> variants = parse_list(arguments.variants);
  return about_option("--variants", [&] { return validation::with_variants(peers, variants); });
}

/// Every scene drawn by every peer. Before any thread is started: see draw_in_child.
std::vector<ValidationCase> draw_all(const std::vector<SceneToMake>& scenes,
                                     const std::vector<Peer>& peers, int seconds,
                                     const std::function<void(double)>& progress) {
  std::vector<ValidationCase> cases;
  const auto count = static_cast<double>(scenes.size() * peers.size());
  for (const SceneToMake& scene : scenes) {
    for (const Peer& peer : peers) {
      ValidationCase made{.scene = scene.name,
                          .renderer = name_of(validation::renderer_of(peer)),
                          .variant = validation::variant_name(peer)};
      validation::Drawing drawing = validation::draw_in_child(peer, scene.make, seconds);
      made.failure = drawing.failure;
      if (drawing.drawn) {
        made.other = std::move(drawing.drawn->map);
        made.model = std::move(drawing.drawn->model);
        made.version = std::move(drawing.drawn->version);
      }
      cases.push_back(std::move(made));
      if (progress) progress(static_cast<double>(cases.size()) / count);
    }
  }
  return cases;
}

void judge_all(std::vector<ValidationCase>& cases, const std::vector<SceneToMake>& scenes) {
  for (const SceneToMake& scene : scenes) {
    const ValidationScene made = scene.make();
    const auto truth = std::make_shared<Truth>(attribution::make_truth(made.scene, made.camera));
    for (ValidationCase& c : cases) {
      if (c.scene != scene.name || !c.is_done()) continue;
      c.attribution = attribution::attribute_and_name(*truth, c.other, c.model);
      c.truth = truth;
    }
  }
}

int validate_against(const ValidateArguments& arguments, const Console& console) {
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  const std::vector<Peer> peers = peers_of(arguments);
  const ReportPlaces places{arguments.out, arguments.baseline};
  prepare(places);
  std::vector<ValidationCase> cases;
  {
    Progress progress(console, "drawing");
    cases = draw_all(scenes, peers, time_limit(arguments), progress.reporter());
  }
  judge_all(cases, scenes);
  return report_cases(cases, places);
}

/// The renderer of --render in the variant that is asked for, else in its first.
Peer peer_to_render(const ValidateArguments& arguments) {
  const auto renderer =
      about_option("--render", [&] { return validation::renderer_named(arguments.render); });
  if (arguments.variants.empty()) {
    return validation::peers_of(renderer, time_limit(arguments)).front();
  }
  return about_option("--variants",
                      [&] { return validation::peer_named(renderer, arguments.variants); });
}

/// What the renderer drew, as a map of ours.
int render_peer(const ValidateArguments& arguments, const Console& console) {
  if (arguments.output.empty()) throw UsageError("-o MAP is missing: where the map goes");
  const auto format = map_format_of(arguments.output);
  if (!format)
    throw UsageError("-o: '" + arguments.output + "' does not end in .exr, .pfm or .npy");
  if (arguments.scenes.empty()) throw UsageError("SCENE is missing: what is rendered");
  const SceneToMake scene = scenes_of(arguments, console).front();
  const Peer peer = peer_to_render(arguments);
  OutputFile output(arguments.output);
  validation::Drawing drawing = validation::draw_in_child(peer, scene.make, time_limit(arguments));
  if (!drawing.drawn) throw InputError(drawing.failure);
  DepthMap map = attribution::as_depth_map(drawing.drawn->map);
  map.texts["fathom.camera"] = to_json(scene.make().camera);
  map.texts["fathom.engine"] = drawing.drawn->version;
  output.write([&](const std::filesystem::path& path) {
    write_map(map, path, *format, {.channel = *format == MapFormat::exr ? "" : "Z"});
  });
  output.commit();
  return done;
}

int run_validate(const ValidateArguments& arguments, const Console& console) {
  const int modes = static_cast<int>(!arguments.map.empty()) +
                    static_cast<int>(!arguments.against.empty()) +
                    static_cast<int>(!arguments.render.empty());
  if (modes != 1) {
    throw UsageError("one of --against RENDERERS, --map MAP and --render RENDERER is expected");
  }
  if (!arguments.against.empty()) return validate_against(arguments, console);
  if (!arguments.render.empty()) return render_peer(arguments, console);
  if (arguments.model.empty()) {
    throw UsageError("--model is missing: there are " + attribution::model_names());
  }
  const ReportPlaces places{arguments.out, arguments.baseline};
  prepare(places);
  const std::vector<ValidationCase> cases{validate_map(arguments, console)};
  return report_cases(cases, places);
}

void add_validate(Command& program) {
  Command& command = program.command(
      "validate", "Hold another renderer's maps against the truth, every difference explained",
      "  fathom validate --against vtk,opengl,embree,blender --out report\n"
      "  fathom validate --against opengl --scene sheets,room --variants unorm16,float32\n"
      "  fathom validate --against vtk spot.obj --camera camera.json\n"
      "  fathom validate --map other.exr --camera camera.json --model gl-unorm24 spot.obj\n"
      "  fathom validate --render vtk spot.obj --camera camera.json -o vtk.exr\n"
      "\nScenes: " +
          fmt::format("{}", fmt::join(validation::scene_names(), ", ")) +
          ".\nModels: " + attribution::model_names() +
          ".\nExit status 1 where a pixel is unexplained or a fault was found; see "
          "docs/validation.md.");
  const auto arguments = std::make_shared<ValidateArguments>();
  command.arguments("SCENE", arguments->scenes, "Meshes and scene files");
  command.option("--against", "NAME", arguments->against,
                 "Renderers that draw the scenes: vtk, opengl, embree, blender");
  command.option("--scene", "NAME", arguments->scene_names,
                 "Scenes of ours instead of SCENE (default: all, see below)");
  command.option("--variants", "NAME", arguments->variants,
                 "Only these variants of the renderers: unorm24, robust, … (default: all)");
  command.option("--size", "WxH", into(arguments->size, parse_size),
                 "Image size without --camera (default 320x240)");
  command.option("--time-limit", "SECONDS", into(arguments->seconds, parse_positive),
                 "Seconds after which a renderer is ended (default 300)");
  command.option("--render", "NAME", arguments->render, "Only draw, with this renderer");
  command.option("-o", "MAP", arguments->output, "Where --render puts its map");
  command.option("--map", "MAP", arguments->map,
                 "The map of another renderer (EXR, PFM, PNG, NPY)");
  command.option("--channel", "NAME", arguments->channel,
                 "Its channel of depths (default: detected)");
  command.option("--camera", "FILE", arguments->camera, "Camera file");
  command.option("--model", "NAME", arguments->model, "What is assumed of the renderer");
  command.option("--out", "DIR", arguments->out, "Folder for report.json and report.html");
  command.option("--baseline", "REPORT", arguments->baseline,
                 "An earlier report.json: exit status 1 if something got worse");
  command.runs([arguments](const Console& console) { return run_validate(*arguments, console); });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "validate", fathom::app::add_validate);
}
