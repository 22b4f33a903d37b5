// fathom dataset bop SCENE: depth images, masks and scene_gt_info.json of a BOP scene.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/dataset/bop_image.h"
#include "apps/dataset/dataset_command.h"
#include "apps/render/render_limits.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"

namespace fathom::app {
namespace {

struct BopArguments : DatasetArguments {
  std::string models;
  std::optional<Size> size;
  bool areas = false;

  [[nodiscard]] bool beyond_is_none() const {
    return render.storage.png_beyond_is_none.value_or(false);
  }
};

/// All that the files of an image depend on.
std::string inputs_of(const BopImage& image, const BopModels& models, const BopArguments& a) {
  std::string text =
      fmt::format("bop 2 areas {} cull {} scale {:a}{}\n", a.areas, static_cast<int>(a.render.cull),
                  image.depth_scale, a.beyond_is_none() ? " beyond none" : "");
  for (const Source& source : models.sources()) {
    text += fmt::format("source {} {}\n", source.sha256, source.path);
  }
  for (const BopInstance& instance : image.instances) {
    text += fmt::format("{}", instance.model);
    for (const auto& row : instance.pose) {
      for (const double entry : row) text += fmt::format(" {:a}", entry);
    }
    text += "\n";
  }
  return text + to_json(image.camera);
}

/// {"0": [facts of its instances], …}, as scene_gt_info.json has them.
std::string info_of(const std::vector<BopImage>& images, const std::vector<std::string>& facts) {
  std::string text = "{\n";
  for (std::size_t i = 0; i < images.size(); ++i) {
    text +=
        fmt::format("  \"{}\": {}{}\n", images[i].id, facts[i], i + 1 == images.size() ? "" : ",");
  }
  return text + "}\n";
}

int run_bop(BopArguments& arguments, const Console& console) {
  const ThreadLimit limit(arguments.render.scene.threads);
  const std::filesystem::path folder = arguments.input;
  for (const char* file : {"scene_camera.json", "scene_gt.json"}) note_input(folder / file);
  const auto [width, height] = arguments.size.value_or(Size{});
  const std::vector<BopImage> images = read_bop_images(folder, width, height);
  Warnings warnings;
  ReadOptions reading = arguments.render.scene.read_options();
  reading.hash = true;
  BopModels models(arguments.models, images, reading, warnings);
  console.warn(warnings);

  BopImageMaker maker(models, {.cull = arguments.render.cull,
                               .threads = arguments.render.scene.threads,
                               .areas = arguments.areas,
                               .beyond_is_none = arguments.beyond_is_none()});
  Job job = arguments.job();
  job.noun = "image";
  for (const BopImage& image : images) {
    job.tasks.push_back({key_of(inputs_of(image, models, arguments)), files_of(image)});
  }
  job.make = [&](std::size_t i) { return maker.make(images[i], job.folder); };
  job.lists.push_back(
      {"scene_gt_info.json", [&](const auto& facts) { return info_of(images, facts); }});
  run_job(job, console);
  maker.warn(console);
  return done;
}

}  // namespace

void add_bop_layout(Command& family) {
  const auto arguments = std::make_shared<BopArguments>();
  Command& command =
      family.command("bop", "Render a scene of BOP: depth images, masks and scene_gt_info.json",
                     "  fathom dataset bop test/000001 --models models -o exact/000001\n"
                     "\nINPUT contains scene_camera.json and scene_gt.json; the image size is read "
                     "from the data set's camera.json, unless --size is given. Visible is the "
                     "nearest surface at the centre of a pixel, without a tolerance.");
  arguments->add_to(command, "The folder of a scene");
  command.option("--models", "DIR", arguments->models, "The folder with obj_000001.ply and so on")
      .required();
  command.option("--size", "WxH", into(arguments->size, parse_size),
                 "Size of the images in pixels, WIDTHxHEIGHT");
  arguments->render.storage.add_beyond_to(command);
  command.flag(
      "--areas", arguments->areas,
      "Write exact areas next to the pixel counts: area_all, area_visib, visib_area_fract");
  command.runs([arguments](const Console& console) { return run_bop(*arguments, console); });
}

}  // namespace fathom::app
