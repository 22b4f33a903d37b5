// fathom dataset bop SCENE: depth images, masks and scene_gt_info.json of a BOP scene.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/dataset/dataset_command.h"
#include "apps/jobs/job.h"
#include "apps/render/render_plan.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/area/visible_areas.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/fast/render_memory.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"
#include "fathom/image/png_files.h"
#include "fathom/image/samples.h"
#include "fathom/render.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/bop_scene.h"

namespace fathom::app {
namespace {

/// A mask, 1 or 0 for each pixel, row by row from the top, with BOP's figures.
struct CountedMask {
  std::vector<std::uint8_t> mask;
  std::uint64_t count = 0;
  /// Of the pixels that it has.
  long first_column = 0, first_row = 0, last_column = -1, last_row = -1;

  /// A box of BOP: x, y, and the differences of the last and the first column and row, in an image
  /// whose corner is at this column and row.
  [[nodiscard]] std::array<long, 4> box(long column, long row) const {
    return {first_column - column, first_row - row, last_column - first_column,
            last_row - first_row};
  }
};

/// The pixels that show an object, or without an object any surface.
CountedMask mask_of(const Samples<std::uint32_t>& objects, std::uint32_t width,
                    std::optional<std::uint32_t> object) {
  CountedMask result;
  result.mask.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (object ? objects[i] != *object : objects[i] == no_surface) continue;
    const auto column = static_cast<long>(i % width), row = static_cast<long>(i / width);
    if (result.count++ == 0) result.first_column = column, result.first_row = row;
    result.mask[i] = 1;
    result.first_column = std::min(result.first_column, column);
    result.last_column = std::max(result.last_column, column);
    result.last_row = row;
  }
  return result;
}

/// The middle ninth of a mask that is three times as wide and as high.
std::vector<std::uint8_t> middle_of(const std::vector<std::uint8_t>& mask, std::uint32_t width,
                                    std::uint32_t height) {
  std::vector<std::uint8_t> middle;
  middle.reserve(std::size_t{width} * height);
  for (std::size_t y = height; y < 2 * std::size_t{height}; ++y) {
    const auto row = mask.begin() + static_cast<long>(y * 3 * width + width);
    middle.insert(middle.end(), row, row + width);
  }
  return middle;
}

using Json = nlohmann::ordered_json;
using Mask = std::vector<std::uint8_t>;

/// The camera of an image three times as wide and as high, with the image of `camera` in its
/// middle. The world is the frame of `camera`. Exact: cx + width need not be a binary64 number, so
/// the matrix adds the width, U = fx·x + skew·y + width·z + cx'·z, and also contains the focal
/// lengths.
Camera around(const Camera& camera) {
  if (std::max(camera.width, camera.height) > std::numeric_limits<std::uint32_t>::max() / 3)
    throw InputError(fmt::format("image {}: an image of {}x{} pixels is too large for masks",
                                 camera.name, camera.width, camera.height));
  Camera wide = camera;
  wide.projection.fx = wide.projection.fy = 1;
  wide.projection.skew = 0;
  wide.world_to_camera = {
      {{camera.projection.fx, camera.projection.skew, static_cast<double>(camera.width), 0},
       {0, camera.projection.fy, static_cast<double>(camera.height), 0},
       {0, 0, 1, 0}}};
  wide.width *= 3;
  wide.height *= 3;
  return wide;
}

double fraction(double part, double whole) {
  return whole == 0 ? 0 : part / whole;
}

/// The number of pixels of a mask whose codes stand for a depth.
std::size_t count_with_depth(const Mask& mask, const Samples<std::uint16_t>& codes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) count += mask[i] != 0 && codes[i] != 0 ? 1 : 0;
  return count;
}

std::function<files::Bytes()> as_png(Mask mask, const BopImage& image, const std::string& name) {
  return [mask = std::move(mask), width = image.camera.width, height = image.camera.height, name] {
    return encode_mask(mask, width, height, name);
  };
}

std::string file_of(const char* folder, const BopImage& image, std::size_t instance) {
  return fmt::format("{}/{}_{:06}.png", folder, image.camera.name, instance);
}

/// The files of an image of BOP: depth/000017.png, then for each instance mask/000017_000002.png
/// and mask_visib/000017_000002.png.
std::vector<std::string> files_of(const BopImage& image) {
  std::vector<std::string> files{fmt::format("depth/{}.png", image.camera.name)};
  for (std::size_t k = 0; k < image.instances.size(); ++k) {
    files.push_back(file_of("mask", image, k));
    files.push_back(file_of("mask_visib", image, k));
  }
  return files;
}

struct BopImageOptions {
  Cull cull = Cull::none;
  int threads = 0;
  /// Exact areas beside the counts.
  bool areas = false;
  /// Depths beyond the last code are stored as 0.
  bool beyond_is_none = false;
};

/// Makes the files of images, and as facts the entries of scene_gt_info.json for each instance:
///   px_count_all     pixels of its silhouette alone, in an image three times as wide and as high
///                    around the image, as bop_toolkit's calc_gt_info.py has it
///   px_count_valid   those of them within the image at which the depth image has a depth
///   px_count_visib   those at which it is the nearest surface
///   visib_fract      px_count_visib / px_count_all, 0 where that is 0
///   bbox_obj         of px_count_all, bbox_visib of px_count_visib: x, y, and the differences of
///                    the last and the first column and row; −1 for all where no pixel is visible
/// and with areas, in pixels:
///   area_all, area_visib   of the silhouette, within that larger image, and of what is visible;
///                          each the exact number rounded once
///   visib_area_fract       the quotient of these two rounded numbers, rounded; 0 where the first
///                          is 0
/// Exact    all counts: a pixel is covered if its centre is.
class BopImageMaker {
 public:
  BopImageMaker(BopModels& models, BopImageOptions options) : models_(models), options_(options) {}

  /// Fails    OutputError if a depth does not fit 16 bits of the image's depth_scale, unless
  ///          `beyond_is_none`.
  [[nodiscard]] Result make(const BopImage& image, const std::filesystem::path& folder);
  /// Warns about depths beyond their codes in the images that have been made.
  void warn(const Console& console) const { codes_beyond_.tell(console); }

 private:
  struct Silhouette;
  [[nodiscard]] Silhouette silhouette_of(const BopImage& image, std::size_t instance);
  [[nodiscard]] RenderOptions rendering(std::vector<Channel> channels) const;

  BopModels& models_;
  BopImageOptions options_;
  RenderMemory memory_, memory_of_silhouettes_;
  CodesBeyond codes_beyond_;
};

struct BopImageMaker::Silhouette {
  CountedMask whole;
  /// Within the image.
  Mask mask;
  double area = 0;
};

RenderOptions BopImageMaker::rendering(std::vector<Channel> channels) const {
  RenderOptions options;
  options.channels = std::move(channels);
  options.cull = options_.cull;
  options.threads = options_.threads;
  return options;
}

BopImageMaker::Silhouette BopImageMaker::silhouette_of(const BopImage& image,
                                                       std::size_t instance) {
  const Scene& scene = models_.scene_of(std::span(image.instances).subspan(instance, 1));
  const Camera wide = around(image.camera);
  const DepthMap map =
      render(scene, wide, rendering({Channel::object}), {.kept = &memory_of_silhouettes_}).map;
  Silhouette silhouette;
  silhouette.whole = mask_of(*map.values<std::uint32_t>("object"), wide.width, std::nullopt);
  silhouette.mask = middle_of(silhouette.whole.mask, image.camera.width, image.camera.height);
  silhouette.whole.mask = {};
  if (options_.areas) {
    silhouette.area = visible_areas(scene, wide, rendering({Channel::Z})).objects[0].unoccluded;
  }
  return silhouette;
}

Result BopImageMaker::make(const BopImage& image, const std::filesystem::path& folder) {
  std::vector<Silhouette> silhouettes;
  for (std::size_t k = 0; k < image.instances.size(); ++k) {
    silhouettes.push_back(silhouette_of(image, k));
  }
  const Scene& scene = models_.scene_of(image.instances);
  RenderOptions options = rendering({Channel::Z, Channel::object});
  options.depth_encoding.type = DepthEncoding::Type::scaled_unorm16;
  options.depth_encoding.scale = 1;
  options.depth_encoding.divisor = image.depth_scale;
  options.depth_encoding.beyond_is_none = options_.beyond_is_none;
  const std::string name = (folder / files_of(image).front()).string();
  const auto map = std::make_shared<const DepthMap>(about_output(
      name, [&] { return render(scene, image.camera, options, {.kept = &memory_}).map; }));
  codes_beyond_.note(*map);
  VisibleAreas areas;
  if (options_.areas) areas = visible_areas(scene, image.camera, rendering({Channel::Z}));

  Result result;
  result.files.push_back([map, name, threads = options_.threads] {
    return encode_map(*map, name, MapFormat::png, {.threads = threads, .channel = "Z"});
  });
  Json facts = Json::array();
  const long width = image.camera.width, height = image.camera.height;
  const Samples<std::uint32_t>& objects = *map->values<std::uint32_t>("object");
  for (std::size_t k = 0; k < silhouettes.size(); ++k) {
    Silhouette& alone = silhouettes[k];
    CountedMask visible = mask_of(objects, image.camera.width, static_cast<std::uint32_t>(k));
    const std::array<long, 4> none{-1, -1, -1, -1};
    Json fact{{"bbox_obj", visible.count == 0 ? none : alone.whole.box(width, height)},
              {"bbox_visib", visible.count == 0 ? none : visible.box(0, 0)},
              {"px_count_all", alone.whole.count},
              {"px_count_valid", count_with_depth(alone.mask, *map->values<std::uint16_t>("Z"))},
              {"px_count_visib", visible.count},
              {"visib_fract", fraction(static_cast<double>(visible.count),
                                       static_cast<double>(alone.whole.count))}};
    if (options_.areas) {
      fact["area_all"] = alone.area;
      fact["area_visib"] = areas.objects[k].visible;
      fact["visib_area_fract"] = fraction(areas.objects[k].visible, alone.area);
    }
    facts.push_back(std::move(fact));
    result.files.push_back(as_png(std::move(alone.mask), image, file_of("mask", image, k)));
    result.files.push_back(as_png(std::move(visible.mask), image, file_of("mask_visib", image, k)));
  }
  result.facts = facts.dump();
  result.memory =
      std::size_t{image.camera.width} * image.camera.height * (6 + 2 * image.instances.size());
  return result;
}

struct BopArguments : DatasetArguments {
  std::string models;
  std::optional<Size> size;
  bool areas = false;

  [[nodiscard]] bool beyond_is_none() const {
    return render.storage.png_beyond_is_none.value_or(false);
  }
};

/// All inputs of the files of an image.
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
