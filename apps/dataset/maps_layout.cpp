// fathom dataset maps CAMERAS: maps of any format, by a pattern of names.

#include <algorithm>
#include <memory>

#include "apps/dataset/layouts.h"
#include "apps/dataset/view_maker.h"
#include "apps/options/camera_options.h"
#include "apps/options/channel_list.h"
#include "apps/options/output_names.h"
#include "apps/render/thread_limit.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/png_sidecar.h"

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

int run_maps(MapsArguments& arguments, const Console& console) {
  const ThreadLimit limit(arguments.render.scene.threads);
  const std::vector<Camera> cameras = read_camera_file(arguments.input, console);
  const std::string pattern =
      arguments.pattern.empty() ? default_pattern(cameras) : arguments.pattern;
  const std::vector<std::string> names = names_of_outputs("--name", pattern, cameras);
  for (const std::string& name : names) require_within_folder("--name", name);
  arguments.render.output = pattern;
  const MapPlan plan = plan_maps(arguments.render);
  ViewMaker maker(arguments.render.scene.read(console, {.hash = true,
                                                        .attributes = plan.needs_normals(),
                                                        .segments = plan.needs_segments()}),
                  cameras, plan);
  Job job = arguments.job();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    Task task{maker.inputs_of(i), {names[i]}};
    if (plan.storage.png_sidecar) task.files.push_back(plan.storage.sidecar_of(names[i]));
    job.tasks.push_back(std::move(task));
  }
  job.make = [&](std::size_t i) {
    const std::string name = (job.folder / names[i]).string();
    const auto map = maker.make(i, name);
    Result result;
    result.files.push_back([map, name, &maker] {
      return encode_map(*map, name, maker.plan().format, maker.plan().writing);
    });
    if (plan.storage.png_sidecar) {
      result.files.push_back([map] {
        text::Bytes bytes;
        text::append(bytes, png_sidecar(*map));
        return bytes;
      });
    }
    result.memory = maker.memory_of(i);
    return result;
  };
  std::error_code error;
  if (!std::filesystem::equivalent(arguments.input, job.folder / "cameras.json", error)) {
    job.lists.push_back({"cameras.json", [&](const auto&) { return to_json(cameras) + "\n"; }});
  }
  run_job(job, console);
  maker.warn(console);
  return done;
}

}  // namespace

void add_maps_layout(Command& family) {
  const auto arguments = std::make_shared<MapsArguments>();
  Command& command = family.command(
      "maps", "Maps of the cameras of a camera file, in any format",
      "  fathom dataset maps cameras.json --mesh room.ply --out maps\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name 'depth/{stem}.npy' --out room\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name '{index:05}.png' --png-scale "
      "1000 --out room\n");
  arguments->add_to(command, "Camera file (JSON), such as camera import makes");
  arguments->add_scene_to(command);
  command.option("--name", "PATTERN", arguments->pattern,
                 "What the maps are called below DIR; the suffix decides the format. {index:04} is "
                 "the camera's number, {name} its name, {stem} that without folders and suffix "
                 "(default {stem}.exr, or {index:06}.exr where cameras have no names)");
  command.option("--channels", "LIST", into(arguments->render.channels, parse_channels),
                 "As render has them (default Z,A in EXR and NPZ, Z in other formats)");
  arguments->render.storage.add_to(command);
  command.option("--background", "D", into(arguments->render.storage.background, parse_background),
                 "What depth channels hold where no surface is: inf (default), 0, nan or a number "
                 "that no surface has (codes of a PNG: 0)");
  command.runs([arguments](const Console& console) { return run_maps(*arguments, console); });
}

}  // namespace fathom::app
