#include "fathom/scene/bop_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <tuple>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/read_scene.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace files;
using namespace text;

namespace {

WorldFromMesh placement_of(const BopInstance& instance) {
  WorldFromMesh placement;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) placement.rows[i][k] = instance.pose[i][k];
  return placement;
}

BopInstance read_instance(const JsonValue& value) {
  BopInstance instance;
  instance.model = static_cast<std::uint32_t>(
      value.at("obj_id").integer(0, std::numeric_limits<std::uint32_t>::max()));
  const auto R = value.at("cam_R_m2c").numbers(9), t = value.at("cam_t_m2c").numbers(3);
  for (std::size_t i = 0; i < 3; ++i) {
    instance.pose[i] = {R[3 * i], R[3 * i + 1], R[3 * i + 2], t[i]};
  }
  if (const auto fault = find_fault(placement_of(instance))) value.fail(*fault);
  return instance;
}

double depth_scale_of(const JsonValue& entry) {
  const auto value = entry.find("depth_scale");
  if (!value) return 1;
  const double scale = value->number();
  if (!(scale > 0)) value->fail("expected a positive number of millimetres");
  return scale;
}

/// The image of an imported camera, in whose frame the world is.
BopImage image_of(const ImportedCamera& imported, const std::string& file) {
  if (!imported.fault.empty()) throw InputError(imported.fault);
  BopImage image;
  const std::string& id = imported.camera.name;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), image.id);
  if (error != std::errc() || end != id.data() + id.size())
    throw InputError(file + ": '" + id + "' is no image id, expected an integer");
  image.camera = imported.camera;
  image.camera.name = fmt::format("{:06}", image.id);
  image.camera.world_to_camera = Camera().world_to_camera;
  return image;
}

}  // namespace

std::vector<BopImage> read_bop_images(const std::filesystem::path& folder, std::uint32_t width,
                                      std::uint32_t height) {
  const StandardArithmetic standard;
  const std::filesystem::path camera_file = camera::bop_camera_file(folder),
                              poses_file = folder / "scene_gt.json";
  const JsonDocument camera_document(InputFile(camera_file).text(), camera_file.string());
  const JsonDocument poses_document(InputFile(poses_file).text(), poses_file.string());
  std::tie(width, height) = camera::bop_image_size(folder, width, height);
  std::vector<BopImage> images;
  for (const ImportedCamera& imported : camera::parse_bop(camera_document.root(), width, height)) {
    const auto poses = poses_document.root().find(imported.camera.name);
    if (!poses) continue;
    BopImage image = image_of(imported, camera_file.string());
    image.depth_scale = depth_scale_of(camera_document.root().at(imported.camera.name));
    for (const JsonValue& value : poses->elements())
      image.instances.push_back(read_instance(value));
    images.push_back(std::move(image));
  }
  if (images.empty())
    throw InputError(poses_file.string() + ": has no image of " + camera_file.string());
  return images;
}

BopModels::BopModels(const std::filesystem::path& folder, const std::vector<BopImage>& images,
                     const ReadOptions& options, Warnings& warnings) {
  std::set<std::uint32_t> wanted;
  for (const BopImage& image : images)
    for (const BopInstance& instance : image.instances) wanted.insert(instance.model);
  std::vector<std::filesystem::path> files;
  files.reserve(wanted.size());
  for (const std::uint32_t number : wanted)
    files.push_back(folder / fmt::format("obj_{:06}.ply", number));
  if (!files.empty()) scene_ = read_scene(files, options, warnings);
  numbers_.assign(wanted.begin(), wanted.end());
  models_ = scene_.objects;
  if (models_.size() != numbers_.size())
    throw InputError(folder.string() + ": expected models of one mesh each");
}

const Scene& BopModels::scene_of(std::span<const BopInstance> instances) {
  scene_.objects.clear();
  for (const BopInstance& instance : instances) {
    const auto at = std::ranges::lower_bound(numbers_, instance.model) - numbers_.begin();
    Object& object = scene_.objects.emplace_back(models_[static_cast<std::size_t>(at)]);
    object.world_from_mesh = placement_of(instance);
    object.placed_as_is = object.world_from_mesh.rows == WorldFromMesh().rows;
    object.name = fmt::format("{} obj_{:06}", scene_.objects.size() - 1, instance.model);
  }
  return scene_;
}

}  // namespace fathom
