// fathom dataset maps CAMERAS: maps of any format, by a pattern of names.

#include <algorithm>
#include <memory>

#include "apps/dataset/dataset_command.h"
#include "apps/dataset/views.h"
#include "apps/options/camera_options.h"
#include "apps/options/map_contents.h"
#include "apps/options/output_names.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/image/png_files.h"

namespace fathom::app {
namespace {

struct MapsArguments : DatasetArguments {
  std::string pattern;
};

std::string default_pattern(const std::vector<Camera>& cameras) {
  const bool named =
      std::ranges::none_of(cameras, [](const Camera& camera) { return camera.name.empty(); });
  return named ? "{stem}.exr" : "{index:06}.exr";
}

files::Bytes encoded_sidecar(const DepthMap& map, const MapPlan&, const std::string&) {
  files::Bytes bytes;
  files::append(bytes, png_sidecar(map));
  return bytes;
}

int run_maps(MapsArguments& arguments, const Console& console) {
  Views views;
  views.cameras = arguments.camera_changes.applied(
      read_cameras_with_lenses(arguments.input, arguments.render.scene.limits, console));
  views.noun = "map";
  arguments.render.output =
      arguments.pattern.empty() ? default_pattern(views.cameras) : arguments.pattern;
  const std::vector<std::string> names =
      names_of_outputs("--name", arguments.render.output, views.cameras);
  for (const std::string& name : names) require_within_folder("--name", name);
  views.files.push_back({names, [](const auto& map, const auto& plan, const auto& name) {
                           return encode_planned(map, plan, name);
                         }});
  const StorageOptions& storage = arguments.render.storage;
  if (storage.png_sidecar) {
    FileOfView& sidecar = views.files.emplace_back(FileOfView{{}, encoded_sidecar});
    for (const std::string& name : names) sidecar.names.push_back(storage.sidecar_of(name));
  }
  std::error_code error;
  views.has_camera_list = !std::filesystem::equivalent(
      arguments.input, std::filesystem::path(arguments.folder) / "cameras.json", error);
  make_views(arguments, views, console);
  return done;
}

}  // namespace

void add_maps_layout(Command& family) {
  const auto arguments = std::make_shared<MapsArguments>();
  Command& command = family.command(
      "maps", "Render a map for each camera of a camera file, in any format",
      "  fathom dataset maps cameras.json --mesh room.ply -o maps\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name '{stem}.npy' -o room\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name '{index:05}.png' \\\n"
      "    --png-scale 1000 -o room");
  arguments->add_to(command, "Camera file (JSON), e.g. from 'fathom camera import'");
  arguments->add_scene_to(command);
  arguments->camera_changes.add_to(command);
  command.option("--name", "PATTERN", arguments->pattern,
                 "Pattern of the file names below DIR; the suffix selects the format. {index:04} "
                 "is the camera's number, {name} its name, {stem} its name without folders and "
                 "suffix (default {stem}.exr, or {index:06}.exr if cameras have no names)");
  command.option(
      "--channels", "LIST",
      [arguments](const std::string& text) { arguments->render.take(parse_contents(text)); },
      "Channels, as for render (default Z,A in EXR and NPZ, Z in other formats), or mask");
  arguments->render.storage.add_to(command);
  command.option("--background", "D", into(arguments->render.storage.background, parse_background),
                 "Depth without a surface: inf (default), 0, nan or a number that no surface has "
                 "(codes of a PNG: 0)");
  command.runs([arguments](const Console& console) { return run_maps(*arguments, console); });
}

}  // namespace fathom::app
