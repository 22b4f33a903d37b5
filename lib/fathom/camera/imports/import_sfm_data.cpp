#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <unordered_map>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/ascii.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using text::in_small_letters;
using text::JsonValue;

namespace fs = std::filesystem;

namespace {

using Version = std::array<std::uint64_t, 3>;

/// The newest that is known.
constexpr Version newest{1, 2, 11};

/// What Boost writes: every number is a string. A number is one, too.
double number_in(const JsonValue& value) {
  if (!value.is_string()) return value.number();
  const double number = number_of(value.string(), value.where());
  if (!std::isfinite(number)) value.fail("expected a finite number");
  return number;
}

std::uint64_t integer_in(const JsonValue& value, std::uint64_t least, std::uint64_t greatest) {
  const double number = number_in(value);
  if (number != std::floor(number) || number < static_cast<double>(least) ||
      number > static_cast<double>(greatest))
    value.fail("expected an integer from " + std::to_string(least) + " to " +
               std::to_string(greatest));
  return static_cast<std::uint64_t>(number);
}

std::uint64_t id_in(const JsonValue& value) {
  return integer_in(value, 0, std::numeric_limits<std::uint32_t>::max());
}

template <std::size_t N>
std::array<double, N> numbers_in(const JsonValue& list) {
  std::array<double, N> numbers;
  std::size_t i = 0;
  for (const JsonValue& each : list.elements(N)) numbers[i++] = number_in(each);
  return numbers;
}

/// A list, which Boost writes as "" where it is empty.
std::vector<JsonValue> elements_of(const std::optional<JsonValue>& list) {
  if (!list || (list->is_string() && list->string().empty())) return {};
  return list->elements();
}

double rounded_quotient(const Dyadic& numerator, const Dyadic& denominator) {
  return round_to_binary64(Ratio(numerator, denominator));
}

/// Fills in the distortion; fails where the lens has no pinhole part.
void read_lens_type(const JsonValue& intrinsic, Version version, ImportedCamera& one) {
  const JsonValue type = intrinsic.at("type");
  std::string name = in_small_letters(type.string());
  std::string distortion = "none", undistortion = "none";
  if (version >= Version{1, 2, 8}) {
    if (name != "pinhole") type.fail("the camera " + name + " is no pinhole camera");
    distortion = in_small_letters(intrinsic.at("distortionType").string());
    undistortion = in_small_letters(intrinsic.at("undistortionType").string());
  } else if (name != "pinhole") {
    distortion = name;  // until then type named both
  }
  if (distortion.starts_with("fisheye") || distortion.starts_with("equidistant"))
    type.fail("the lens " + distortion + " is no pinhole camera; undistort the images first");
  bool is_distorted = undistortion != "none" || distortion.starts_with("3de");
  for (const JsonValue& parameter : elements_of(intrinsic.find("distortionParams")))
    is_distorted = is_distorted || number_in(parameter) != 0;
  if (is_distorted)
    one.distortion = intrinsic.where() + ": the lens " +
                     (undistortion != "none" ? undistortion : distortion) + " has distortion";
}

/// fx and fy in pixels; before 1.2.2 these are in the file, then a focal length in millimetres and
/// a ratio, whose meaning changed twice.
void read_focal_lengths(const JsonValue& intrinsic, Version version, Camera& camera) {
  if (version < Version{1, 2, 0}) {
    camera.projection.fx = camera.projection.fy = number_in(intrinsic.at("pxFocalLength"));
    return;
  }
  if (version < Version{1, 2, 2}) {
    const auto focal = numbers_in<2>(intrinsic.at("pxFocalLength"));
    camera.projection.fx = focal[0];
    camera.projection.fy = focal[1];
    return;
  }
  const auto number = [&](const char* key, double otherwise) {
    const auto value = intrinsic.find(key);
    return Dyadic(value ? number_in(*value) : otherwise);
  };
  const Dyadic focal = number("focalLength", 1), ratio = number("pixelRatio", 1),
               sensor = number("sensorWidth", 36), width = camera.width;
  if (sensor.sign() != Sign::positive) intrinsic.fail("expected a positive sensorWidth");
  if (ratio.sign() != Sign::positive) intrinsic.fail("expected a positive pixelRatio");
  const Dyadic pixels = focal * width;  // times the sensor's width
  if (version < Version{1, 2, 5}) {
    camera.projection.fx = rounded_quotient(pixels, sensor);
    camera.projection.fy = rounded_quotient(pixels, sensor * ratio);
  } else if (version < Version{1, 2, 11}) {
    camera.projection.fx = rounded_quotient(pixels, sensor);
    camera.projection.fy = rounded_quotient(pixels * ratio, sensor);
  } else {
    camera.projection.fx = rounded_quotient(pixels, sensor * ratio);
    camera.projection.fy = rounded_quotient(pixels, sensor);
  }
}

ImportedCamera read_intrinsic(const JsonValue& intrinsic, Version version) {
  return imported_camera("intrinsic", intrinsic.where(), [&](ImportedCamera& one) {
    Camera& camera = one.camera;
    const auto size = [&](const char* key) {
      return static_cast<std::uint32_t>(
          integer_in(intrinsic.at(key), 1, std::numeric_limits<std::uint32_t>::max()));
    };
    camera.width = size("width");
    camera.height = size("height");
    camera.projection.pixel_centre = 0;
    read_lens_type(intrinsic, version, one);
    read_focal_lengths(intrinsic, version, camera);
    const auto principal = numbers_in<2>(intrinsic.at("principalPoint"));
    camera.projection.cx = principal[0];
    camera.projection.cy = principal[1];
    if (version >= Version{1, 2, 1}) {  // versions since 1.2.1 count from the middle of the image
      camera.projection.cx =
          round_to_binary64(Ratio(Dyadic(principal[0]) + Dyadic(camera.width / 2.0)));
      camera.projection.cy =
          round_to_binary64(Ratio(Dyadic(principal[1]) + Dyadic(camera.height / 2.0)));
    }
  });
}

/// [R | −R·c]: R takes world to camera and stands column by column, c is the eye.
Pose read_pose(const JsonValue& pose) {
  const JsonValue transform = pose.at("pose").at("transform");
  const auto flat = numbers_in<9>(transform.at("rotation"));
  const auto eye = numbers_in<3>(transform.at("center"));
  Matrix3 R;
  for (std::size_t i = 0; i < 9; ++i) R[i % 3][i / 3] = flat[i];
  return pose_that_takes(R, {eye[0], eye[1], eye[2]}, {});
}

Version read_version(const JsonValue& root) {
  Version version;
  std::size_t i = 0;
  const JsonValue list = root.at("version");
  for (const JsonValue& part : list.elements(3)) version[i++] = integer_in(part, 0, 1'000'000);
  if (version > newest || version[0] < 1)
    list.fail("expected 1.0.0 to 1.2.11; convert the file with aliceVision_convertSfMFormat");
  return version;
}

/// The folder that the paths have in common.
fs::path common_folder(const std::vector<fs::path>& paths) {
  fs::path common = paths.front().parent_path();
  for (const fs::path& path : paths) {
    const auto [end, ignored] =
        std::mismatch(common.begin(), common.end(), path.begin(), std::prev(path.end()));
    fs::path shorter;
    for (auto part = common.begin(); part != end; ++part) shorter /= *part;
    common = shorter;
  }
  return common;
}

/// Their paths below the folder that all have in common; of a view without a path, its number.
std::vector<std::string> names_of(const std::vector<JsonValue>& views) {
  std::vector<std::string> names;
  std::vector<fs::path> paths;
  for (const JsonValue& view : views) {
    const auto path = view.find("path");
    names.push_back(path ? path->string() : "");
    if (names.back().empty())
      names.back() = std::to_string(id_in(view.at("viewId")));
    else if (fs::path(names.back()).has_filename())
      paths.emplace_back(names.back());
    else
      path->fail("expected the path of a file");
  }
  if (paths.size() != names.size()) return names;
  const fs::path folder = common_folder(paths);
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = paths[i].lexically_relative(folder).string();
  if (folder.empty())
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = paths[i].string();
  return names;
}

template <class Value, class Read>
std::unordered_map<std::uint64_t, Value> by_id(const JsonValue& root, const char* list,
                                               const char* key, const Read& read) {
  std::unordered_map<std::uint64_t, Value> found;
  for (const JsonValue& entry : elements_of(root.find(list))) {
    const JsonValue id = entry.at(key);
    if (!found.emplace(id_in(id), read(entry)).second) id.fail("stands twice");
  }
  return found;
}

/// Whether a view's pose is the pose of a rig: it names a rig and does not declare its own pose.
bool is_of_a_rig(const JsonValue& view) {
  const auto rig = view.find("rigId"), own = view.find("isPoseIndependant");
  if (!rig || (own && own->is_string() && own->string() == "true")) return false;
  const double id = number_in(*rig);
  return id >= 0 && id != std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

std::vector<ImportedCamera> camera::parse_sfm_data(const NamedText& file) {
  const text::JsonDocument document(file.text, file.name);
  const JsonValue root = document.root();
  const Version version = read_version(root);
  const auto lenses =
      by_id<ImportedCamera>(root, "intrinsics", "intrinsicId",
                            [&](const JsonValue& entry) { return read_intrinsic(entry, version); });
  const auto poses =
      by_id<JsonValue>(root, "poses", "poseId", [](const JsonValue& entry) { return entry; });
  const std::vector<JsonValue> views = elements_of(root.find("views"));
  if (views.empty()) root.fail("there is no view");
  const std::vector<std::string> names = names_of(views);
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& view : views) {
    const std::string& name = names[cameras.size()];
    cameras.push_back(imported_camera(name, view.where(), [&](ImportedCamera& one) {
      const JsonValue intrinsic = view.at("intrinsicId");
      const auto pose_id = view.find("poseId");
      const auto pose = pose_id ? poses.find(id_in(*pose_id)) : poses.end();
      const auto lens = lenses.find(id_in(intrinsic));
      if (pose == poses.end() || lens == lenses.end()) {
        one.absence = view.where() + ": the view was not reconstructed: it has no pose";
        return;
      }
      if (is_of_a_rig(view)) view.fail("the view belongs to a rig, which is not read");
      one = lens->second;
      if (!one.fault.empty()) return;
      one.camera.world_to_camera = read_pose(pose->second);
      if (const auto fault = find_fault(one.camera)) pose->second.fail(*fault);
    }));
  }
  require_different_names(cameras, file.name);
  return cameras;
}

std::vector<ImportedCamera> import_sfm_data(const fs::path& file) {
  const StandardArithmetic standard;
  const files::InputFile input(file);
  return parse_sfm_data({input.text(), file.string()});
}

}  // namespace fathom
