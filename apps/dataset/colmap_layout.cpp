// fathom dataset colmap MODEL: depth and normal maps of COLMAP's dense workspace.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/camera/import_sources.h"
#include "apps/dataset/dataset_command.h"
#include "apps/dataset/views.h"
#include "apps/options/output_names.h"
#include "apps/shell/failures.h"
#include "fathom/text/counted.h"

namespace fathom::app {
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
