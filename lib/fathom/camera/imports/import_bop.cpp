#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using namespace files;
using namespace text;

namespace fs = std::filesystem;

namespace {

std::uint64_t image_id(const std::string& key, const JsonValue& value) {
  std::uint64_t id = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), id);
  if (error != std::errc{} || end != key.data() + key.size())
    value.fail("expected the keys to be image ids, which are integers");
  return id;
}

void read_intrinsics(const JsonValue& cam_K, Camera& camera) {
  const auto numbers = cam_K.numbers(9);
  IntrinsicMatrix K;
  std::copy(numbers.begin(), numbers.end(), K.begin());
  set_intrinsics(camera.projection, K, cam_K.where());
  camera.projection.pixel_centre = 0;
}

void read_pose(const JsonValue& entry, Camera& camera) {
  const auto rotation = entry.find("cam_R_w2c"), translation = entry.find("cam_t_w2c");
  if (rotation.has_value() != translation.has_value())
    entry.fail("expected both cam_R_w2c and cam_t_w2c, or neither");
  if (!rotation) return;
  const auto R = rotation->numbers(9), t = translation->numbers(3);
  for (std::size_t i = 0; i < 3; ++i)
    camera.world_to_camera[i] = {R[3 * i], R[3 * i + 1], R[3 * i + 2], t[i]};
}

}  // namespace

std::vector<ImportedCamera> camera::parse_bop(std::string_view text, const std::string& name,
                                              std::uint32_t width, std::uint32_t height) {
  return parse_bop(JsonDocument(text, name).root(), width, height);
}

std::vector<ImportedCamera> camera::parse_bop(const JsonValue& root, std::uint32_t width,
                                              std::uint32_t height) {
  std::vector<std::pair<std::uint64_t, ImportedCamera>> cameras;
  for (const auto& [key, entry] : root.members()) {
    const JsonValue& own = entry;
    cameras.push_back(
        {image_id(key, entry), imported_camera(key, own.where(), [&](ImportedCamera& one) {
           one.camera.width = width;
           one.camera.height = height;
           read_intrinsics(own.at("cam_K"), one.camera);
           read_pose(own, one.camera);
         })});
  }
  if (cameras.empty()) root.fail("there is no image");
  std::stable_sort(cameras.begin(), cameras.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ImportedCamera> result;
  result.reserve(cameras.size());
  for (auto& [id, camera] : cameras) result.push_back(std::move(camera));
  return result;
}

std::pair<std::uint32_t, std::uint32_t> camera::parse_bop_size(std::string_view text,
                                                               const std::string& name) {
  const JsonDocument document(text, name);
  const auto size = [&](const char* key) {
    return static_cast<std::uint32_t>(
        document.root().at(key).integer(1, std::numeric_limits<std::uint32_t>::max()));
  };
  return {size("width"), size("height")};
}

namespace {

/// The camera.json of a data set, which lies two folders above the folders of its scenes.
fs::path find_camera_json(const fs::path& folder) {
  std::error_code ignored;
  const fs::path start = folder.empty() ? fs::path(".") : folder;
  for (const fs::path& place : {start, start / "..", start / ".." / ".."})
    if (fs::exists(place / "camera.json", ignored)) return place / "camera.json";
  throw InputError(start.string() +
                   ": the image size is unknown: there is no camera.json in this folder or the two "
                   "above; give the size (--size, in Python size=)");
}

}  // namespace

fs::path camera::bop_camera_file(const fs::path& folder) {
  fs::path file = folder / "scene_camera.json";
  std::error_code ignored;
  if (fs::exists(file, ignored)) return file;
  throw InputError(folder.string() +
                   ": has no scene_camera.json: give the folder of a scene, as test/000001");
}

std::pair<std::uint32_t, std::uint32_t> camera::bop_image_size(const fs::path& folder,
                                                               std::uint32_t width,
                                                               std::uint32_t height) {
  if (width != 0 || height != 0) return {width, height};
  const fs::path file = find_camera_json(folder);
  return parse_bop_size(InputFile(file).text(), file.string());
}

std::vector<ImportedCamera> import_bop(const fs::path& input, std::uint32_t width,
                                       std::uint32_t height) {
  const StandardArithmetic standard;
  std::error_code ignored;
  const fs::path file = fs::is_directory(input, ignored) ? bop_camera_file(input) : input;
  const InputFile cameras(file);
  std::tie(width, height) = bop_image_size(file.parent_path(), width, height);
  return parse_bop(cameras.text(), file.string(), width, height);
}

}  // namespace fathom
