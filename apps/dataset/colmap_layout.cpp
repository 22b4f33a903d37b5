// fathom dataset colmap MODEL: depth and normal maps of COLMAP's dense workspace.

#include <memory>

#include "apps/camera/import_sources.h"
#include "apps/dataset/layouts.h"
#include "apps/dataset/view_maker.h"
#include "apps/options/output_names.h"
#include "apps/render/thread_limit.h"
#include "apps/shell/exit_status.h"
#include "fathom/camera/camera_files.h"

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

int run_colmap(ColmapArguments& arguments, const Console& console) {
  const ThreadLimit limit(arguments.render.scene.threads);
  Warnings warnings;
  const std::vector<Camera> cameras =
      chosen_cameras(import_colmap(arguments.input), arguments.input, arguments.choice, warnings);
  console.warn(warnings);
  const auto depths =
      names_of_outputs("the layout", "stereo/depth_maps/{name}.geometric.bin", cameras);
  const auto normals =
      names_of_outputs("the layout", "stereo/normal_maps/{name}.geometric.bin", cameras);
  // Both channels of one map, as an EXR has them; they are written one by one.
  arguments.render.output = "both.exr";
  arguments.render.channels = {Channel::Z, Channel::Nc};
  ViewMaker maker(arguments.render.scene.read(console, {.hash = true}), cameras,
                  plan_maps(arguments.render));
  Job job = arguments.job();
  job.noun = "depth and normal map";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    job.tasks.push_back({"colmap 1\n" + maker.inputs_of(i), {depths[i], normals[i]}});
  }
  job.make = [&](std::size_t i) {
    const auto map = maker.make(i, (job.folder / depths[i]).string());
    const auto encoded = [map](const std::string& name, const char* channel) {
      return [map, name, channel] {
        return encode_map(*map, name, MapFormat::colmap, {.channel = channel});
      };
    };
    Result result;
    result.files = {encoded(depths[i], "Z"), encoded(normals[i], "Nc")};
    result.memory = maker.memory_of(i);
    return result;
  };
  job.lists.push_back({"cameras.json", [&](const auto&) { return to_json(cameras) + "\n"; }});
  job.lists.push_back({"stereo/fusion.cfg", [&](const auto&) { return list_of(cameras); }});
  run_job(job, console);
  maker.warn(console);
  return done;
}

}  // namespace

void add_colmap_layout(Command& family) {
  const auto arguments = std::make_shared<ColmapArguments>();
  Command& command = family.command(
      "colmap", "COLMAP: stereo/depth_maps and stereo/normal_maps of a dense workspace",
      "  fathom dataset colmap dense/sparse --mesh mesh.ply --out exact\n"
      "\nWith links to dense/images and dense/sparse in it, 'colmap stereo_fusion' takes the "
      "folder "
      "as its workspace.");
  arguments->add_to(command, "The folder of the model");
  arguments->add_scene_to(command);
  add_distortion_option(command, arguments->choice);
  command.runs([arguments](const Console& console) { return run_colmap(*arguments, console); });
}

}  // namespace fathom::app
