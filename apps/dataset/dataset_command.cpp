#include "apps/dataset/dataset_command.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <utility>

#include "apps/options/map_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/fast/render_memory.h"
#include "fathom/render.h"
#include "fathom/scene/scene.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

/// Makes the map of each camera of a path, for the tasks of a job.
class ViewMaker {
 public:
  /// Fails    InputError where memory does not hold a map of one of the cameras.
  ViewMaker(Scene scene, std::vector<Camera> cameras, MapPlan plan);

  /// What the map of a camera depends on, for the key of its task.
  [[nodiscard]] std::string inputs_of(std::size_t camera) const;
  /// `name` is the map's for messages.
  [[nodiscard]] std::shared_ptr<const DepthMap> make(std::size_t camera, const std::string& name);
  /// About so many bytes does a map of this camera take.
  [[nodiscard]] std::size_t memory_of(std::size_t camera) const;

  [[nodiscard]] const MapPlan& plan() const { return plan_; }
  /// Warns of what is probably not meant by the cameras whose maps have been made, and of depths
  /// that lie beyond their codes.
  void warn(const Console& console) const;

 private:
  Scene scene_;
  std::vector<Camera> cameras_;
  MapPlan plan_;
  std::string inputs_;
  RenderMemory memory_;
  CameraWarnings warnings_;
  CodesBeyond codes_beyond_;
};

/// What decides about the bytes of all maps: their sources, and how they are rendered and stored.
std::string description_of(const Scene& scene, const MapPlan& plan) {
  std::string text = "maps 1\n";
  for (const Source& source : scene.sources) {
    text += fmt::format("source {} {} {}\n", source.sha256, source.reader, source.path);
  }
  const RenderOptions& rendering = plan.rendering;
  text +=
      fmt::format("channels {} cull {} depth {} {:a} normals {}\n", text_of(rendering.channels),
                  static_cast<int>(rendering.cull), static_cast<int>(rendering.depth_encoding.type),
                  rendering.depth_encoding.scale, static_cast<int>(rendering.normals));
  text += fmt::format("format {} compression {}", static_cast<int>(plan.format),
                      static_cast<int>(plan.writing.compression));
  if (plan.is_mask) text += " mask";
  const NormalCoding& normals = plan.writing.normals;
  if (normals.bits != 8) text += fmt::format(" bits {}", normals.bits);
  if (normals.axes != NormalAxes::opencv) text += fmt::format(" axes {}", name_of(normals.axes));
  if (rendering.depth_encoding.beyond_is_none) text += " beyond none";
  if (plan.storage.background) text += fmt::format(" background {:a}", *plan.storage.background);
  for (const ChannelName& name : plan.storage.channel_names) {
    text += fmt::format(" {}={}", name.channel, name.in_file);
  }
  return text + "\n";
}

ViewMaker::ViewMaker(Scene scene, std::vector<Camera> cameras, MapPlan plan)
    : scene_(std::move(scene)), cameras_(std::move(cameras)), plan_(std::move(plan)) {
  inputs_ = description_of(scene_, plan_);
  check_cameras(cameras_, plan_, "a map");
}

std::string ViewMaker::inputs_of(std::size_t camera) const {
  return inputs_ + to_json(cameras_[camera], Digits::seventeen);
}

std::size_t ViewMaker::memory_of(std::size_t camera) const {
  const RenderOptions rendering = plan_.rendering_for(cameras_[camera]);
  const std::size_t of_value = rendering.depth_encoding.type == DepthEncoding::Type::binary64
                                   ? sizeof(double)
                                   : sizeof(float);
  return std::size_t{cameras_[camera].width} * cameras_[camera].height * of_value *
         count_parts(rendering.channels);
}

std::shared_ptr<const DepthMap> ViewMaker::make(std::size_t camera, const std::string& name) {
  const RenderOptions options = plan_.rendering_for(cameras_[camera]);
  Rendered rendered = about_output(
      name, [&] { return render(scene_, cameras_[camera], options, {.kept = &memory_}); });
  warnings_.note(scene_, cameras_[camera], rendered.statistics.pixels_with_surface);
  codes_beyond_.note(rendered.map);
  return std::make_shared<const DepthMap>(plan_.storage.dressed(
      std::move(rendered.map), name, std::numeric_limits<double>::infinity()));
}

void ViewMaker::warn(const Console& console) const {
  warnings_.tell(console);
  codes_beyond_.tell(console);
}

}  // namespace

void CodesBeyond::note(const DepthMap& map) {
  if (map.codes_beyond.value_or(0) == 0) return;
  pixels_ += *map.codes_beyond;
  ++maps_;
}

void CodesBeyond::tell(const Console& console) const {
  if (pixels_ == 0) return;
  console.warn(fmt::format("{} in {} lie beyond the last code and are stored as 0",
                           text::counted(pixels_, "pixel"), text::counted(maps_, "map")));
}

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

void DatasetArguments::add_to(Command& command, const std::string& what) {
  command.argument("INPUT", input, what).required();
  add_output_option(command, "DIR", folder, "Folder of the data set; created if missing")
      .required();
  render.scene.add_reading_to(command);
  add_cull_option(command, render.cull);
  command.option("--shard", "I/N", into(shard, parse_shard),
                 "Render every Nth map, beginning with the Ith, so that N machines share the work");
  command.flag(
      "--overwrite", overwrites,
      "Overwrite existing files, even those not made by fathom; where a name is a symbolic "
      "link, the link stays and the file it leads to is overwritten");
}

void DatasetArguments::add_scene_to(Command& command) {
  command
      .option_with_values("--mesh", "FILE", render.scene.files,
                          "Mesh or scene file to render; repeat the option for several")
      .required();
}

Job DatasetArguments::job() const {
  Job job;
  job.folder = folder;
  job.shard = shard;
  job.overwrites = overwrites;
  return job;
}

void add_dataset(Command& program) {
  Command& family = program.command(
      "dataset", "Render all maps of a data set in its own layout; resume an interrupted run",
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name '{stem}.npy' -o room\n"
      "\nEach map appears as soon as it is finished; DIR/fathom-manifest.jsonl lists the finished "
      "maps. If you repeat the command, it renders only maps that are missing, damaged or made "
      "from other inputs. Layouts: data-sets.md in the documentation.");
  family.requires_command();
  add_maps_layout(family);
  add_colmap_layout(family);
  add_depth_image_layouts(family);
  add_bop_layout(family);
}

}  // namespace fathom::app
