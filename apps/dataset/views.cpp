#include "apps/dataset/views.h"

#include "apps/dataset/view_maker.h"
#include "apps/render/render_limits.h"
#include "fathom/camera/camera_files.h"

namespace fathom::app {

void make_views(const DatasetArguments& arguments, const Views& views, const Console& console) {
  const ThreadLimit limit(arguments.render.scene.threads);
  const MapPlan plan = plan_maps(arguments.render);
  ViewMaker maker(arguments.render.scene.read(console, {.hash = true,
                                                        .attributes = plan.needs_normals(),
                                                        .segments = plan.needs_segments()}),
                  views.cameras, plan);
  Job job = arguments.job();
  job.noun = views.noun;
  for (std::size_t i = 0; i < views.cameras.size(); ++i) {
    Task task{key_of(views.inputs + maker.inputs_of(i)), {}};
    for (const FileOfView& file : views.files) task.files.push_back(file.names[i]);
    job.tasks.push_back(std::move(task));
  }
  job.make = [&](std::size_t i) {
    const auto name_of = [&](const FileOfView& file) {
      return (job.folder / file.names[i]).string();
    };
    const auto map = maker.make(i, name_of(views.files.front()));
    Result result;
    for (const FileOfView& file : views.files) {
      result.files.push_back([map, name = name_of(file), &file, &maker] {
        return file.encode(*map, maker.plan(), name);
      });
    }
    result.memory = maker.memory_of(i);
    return result;
  };
  if (views.has_camera_list) {
    job.lists.push_back(
        {"cameras.json", [&](const auto&) { return to_json(views.cameras) + "\n"; }});
  }
  job.lists.insert(job.lists.end(), views.lists.begin(), views.lists.end());
  run_job(job, console);
  maker.warn(console);
}

}  // namespace fathom::app
