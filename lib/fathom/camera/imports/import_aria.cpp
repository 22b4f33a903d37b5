#include <algorithm>
#include <array>
#include <span>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

/// A camera of the file, and what the file has about its image: ConfigData, or the list of sizes.
struct AriaEntry {
  JsonValue camera;
  std::optional<JsonValue> size;
};

std::array<JsonValue, 2> size_of_aria(const AriaEntry& entry) {
  if (const auto config = entry.camera.find("ConfigData"))
    return {config->at("ImageWidth"), config->at("ImageHeight")};
  if (!entry.size)
    entry.camera.fail(
        "has no image size: expected ConfigData or ImageSizes, or a size that is given (--size, in "
        "Python size=)");
  const auto size = entry.size->elements(2);
  return {size[0], size[1]};
}

/// FisheyeRadTanThinPrism with one focal length: f cu cv k0 … k5 p0 p1 s0 … s3.
void read_fisheye624(const JsonValue& list, ImportedCamera& one) {
  const std::vector<double> numbers = list.numbers(3 + fisheye624_numbers);
  set_intrinsics(one.camera.projection, std::array{numbers[0], numbers[0], numbers[1], numbers[2]});
  set_fisheye624(one, std::span(numbers).subspan(3), list.where());
}

/// KannalaBrandtK3: fx fy cx cy kb0 kb1 kb2 kb3.
void read_kannala_brandt(const JsonValue& list, ImportedCamera& one) {
  const std::vector<double> numbers = list.numbers(8);
  set_intrinsics(one.camera.projection, std::span(numbers).first<4>());
  const std::array<LensNumber, 4> named{
      {{"k1", numbers[4]}, {"k2", numbers[5]}, {"k3", numbers[6]}, {"k4", numbers[7]}}};
  set_lens(one, "OPENCV_FISHEYE", named, list.where());
}

void read_aria_lens(const JsonValue& camera, ImportedCamera& one) {
  const JsonValue projection = camera.at("Projection"), name = projection.at("Name");
  if (name.string() == "FisheyeRadTanThinPrism") {
    read_fisheye624(projection.at("Params"), one);
  } else if (name.string() == "KannalaBrandtK3") {
    read_kannala_brandt(projection.at("Params"), one);
  } else {
    name.fail("found " + text::printable(name.string()) +
              ", expected FisheyeRadTanThinPrism or KannalaBrandtK3");
  }
  const auto config = camera.find("ConfigData");
  if (config && one.camera.projection.lens) {
    const JsonValue angle = config->at("MaxSolidAngle");
    if (!(angle.number() > 0)) angle.fail("expected an angle greater than 0");
    one.camera.projection.lens->max_radius = angle.number();
  }
}

/// T_Device_Camera, inverted: Translation, and UnitQuaternion as [w, [x, y, z]].
ExactPose camera_from_device(const JsonValue& pose) {
  const auto t = pose.at("Translation").numbers(3);
  const JsonValue rotation = pose.at("UnitQuaternion");
  const auto parts = rotation.elements(2);
  const double w = parts[0].number();
  const auto v = parts[1].numbers(3);
  const std::array<double, 4> quaternion{w, v[0], v[1], v[2]};
  if (quaternion == std::array<double, 4>{}) rotation.fail("the quaternion is zero");
  return exact_view_from({t[0], t[1], t[2]}, quaternion);
}

RigCamera read_aria_camera(const AriaEntry& entry, const GivenLens& given) {
  RigCamera result;
  const JsonValue& camera = entry.camera;
  result.camera =
      imported_camera(camera.at("Label").string(), camera.where(), [&](ImportedCamera& one) {
        if (const auto is_calibrated = camera.find("Calibrated");
            is_calibrated && !is_calibrated->boolean())
          one.absence = camera.where() + ": is not calibrated";
        result.from_rig = camera_from_device(camera.at("T_Device_Camera"));
        set_image(one.camera, given, [&] { return size_of_aria(entry); });
        if (one.absence.empty()) read_aria_lens(camera, one);
      });
  return result;
}

std::vector<RigCamera> read_device(const JsonValue& root, const GivenLens& given) {
  const auto list = root.at("CameraCalibrations").elements();
  std::optional<std::vector<JsonValue>> sizes;
  if (const auto found = root.find("ImageSizes")) sizes = found->elements(list.size());
  std::vector<RigCamera> rig;
  for (std::size_t i = 0; i < list.size(); ++i)
    rig.push_back(
        read_aria_camera({list[i], sizes ? std::optional(sizes->at(i)) : std::nullopt}, given));
  return rig;
}

}  // namespace

std::vector<ImportedCamera> cameras_of_aria(std::string_view json, const std::string& file,
                                            const GivenLens& given, const CalibrationPoses& poses) {
  const StandardArithmetic standard;
  const text::JsonDocument document(json, file);
  return at_poses(read_device(document.root(), given), file, poses);
}

}  // namespace fathom
