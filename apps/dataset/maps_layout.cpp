// fathom dataset maps CAMERAS: maps of any format, by a pattern of names.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/camera/import_sources.h"
#include "apps/dataset/dataset_command.h"
#include "apps/options/camera_options.h"
#include "apps/options/output_arguments.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/png_files.h"
#include "fathom/text/counted.h"

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
      [arguments](const std::string& text) {
        const Contents contents = parse_channels_of_outputs(text);
        if (contents.mask_beside)
          throw UsageError(
              "'mask' needs separate files: make them by another run with --channels mask, and "
              "leave it out of the list");
        arguments->render.take(contents);
      },
      "Channels, as for render (default Z,A in EXR and NPZ, Z in other formats), or mask");
  arguments->render.storage.add_to(command);
  command.option("--background", "D", into(arguments->render.storage.background, parse_background),
                 "Depth without a surface: inf (default), 0, nan or a number that no surface has "
                 "(codes of a PNG: 0)");
  command.runs([arguments](const Console& console) { return run_maps(*arguments, console); });
}

// fathom dataset colmap MODEL: depth and normal maps of COLMAP's dense workspace.

namespace {

struct ColmapArguments : DatasetArguments {
  CameraChoice choice;
};

std::string list_of(const std::vector<Camera>& cameras) {
  std::string text;
  for (const Camera& camera : cameras) text += camera.name + "\n";
  return text;
}

FileOfView colmap_file(const char* pattern, const std::vector<Camera>& cameras,
                       const char* channel) {
  return {names_of_outputs("the layout", pattern, cameras),
          [channel](const DepthMap& map, const MapPlan&, const std::string& name) {
            return encode_map(map, name, MapFormat::colmap, {.channel = channel});
          }};
}

/// COLMAP's dense workspace has undistorted images, on which maps of a lens do not lie.
void warn_of_lenses(const std::vector<Camera>& cameras, Warnings& warnings) {
  const auto count = std::ranges::count_if(
      cameras, [](const Camera& camera) { return bends_rays(camera.projection); });
  if (count == 0) return;
  warnings.push_back(fmt::format(
      "{} of {} {} lens distortion, but stereo/ belongs to undistorted images: take the model that "
      "'colmap image_undistorter' makes, or the pinhole part with --ignore-distortion",
      count, text::counted(cameras.size(), "camera"), count == 1 ? "has" : "have"));
}

int run_colmap(ColmapArguments& arguments, const Console& console) {
  Warnings warnings;
  Views views;
  views.cameras =
      chosen_cameras(import_colmap(arguments.input), arguments.input, arguments.choice, warnings);
  warn_of_lenses(views.cameras, warnings);
  console.warn(warnings);
  views.noun = "depth and normal map";
  views.inputs = "colmap 1\n";
  views.files = {colmap_file("stereo/depth_maps/{name}.geometric.bin", views.cameras, "Z"),
                 colmap_file("stereo/normal_maps/{name}.geometric.bin", views.cameras, "Nc")};
  views.lists.push_back({"stereo/fusion.cfg", [&](const auto&) { return list_of(views.cameras); }});
  // Both channels of one map, as an EXR has them; they are written one by one.
  arguments.render.output = "both.exr";
  arguments.render.channels = {Channel::Z, Channel::Nc};
  make_views(arguments, views, console);
  return done;
}

}  // namespace

void add_colmap_layout(Command& family) {
  const auto arguments = std::make_shared<ColmapArguments>();
  Command& command = family.command(
      "colmap", "Render stereo/depth_maps and stereo/normal_maps of a dense workspace of COLMAP",
      "  fathom dataset colmap dense/sparse --mesh mesh.ply -o exact\n"
      "\nWith links to dense/images and dense/sparse in it, 'colmap stereo_fusion' takes the "
      "folder "
      "as its workspace.");
  arguments->add_to(command, "The folder of the model");
  arguments->add_scene_to(command);
  add_distortion_option(command, arguments->choice);
  command.runs([arguments](const Console& console) { return run_colmap(*arguments, console); });
}

}  // namespace fathom::app
