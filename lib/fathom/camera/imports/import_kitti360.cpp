#include <fmt/core.h>

#include <array>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

/// Mei's lens, as camodocal's CataCamera has it.
void read_mei(const JsonValue& root, ImportedCamera& one) {
  const JsonValue type = root.at("model_type");
  if (type.string() != "MEI")
    type.fail("found " + text::printable(type.string()) + ", expected MEI");
  const JsonValue projection = root.at("projection_parameters");
  set_intrinsics(one.camera.projection,
                 std::array{projection.at("gamma1").number(), projection.at("gamma2").number(),
                            projection.at("u0").number(), projection.at("v0").number()});
  std::vector<LensNumber> numbers{{"xi", root.at("mirror_parameters").at("xi").number()}};
  const JsonValue distortion = root.at("distortion_parameters");
  for (const char* key : {"k1", "k2", "p1", "p2"})
    numbers.push_back({key, distortion.at(key).number()});
  set_lens(one, "OMNI", numbers, root.where());
}

/// Vehicle to camera, from the line "image_02: 12 numbers" of the inverse.
ExactPose camera_from_vehicle(const NamedText& rig, const std::string& camera) {
  for (Line& line : lines_of(rig.text, rig.name)) {
    if (read_word(line, "the name of a camera") != camera + ":") continue;
    return exact_inverse(pose_of_numbers(rest_of(line), line.where), line.where);
  }
  throw InputError(rig.name + ": has no line of the camera " + text::printable(camera));
}

/// World to camera at each frame: a line of its number and 12 numbers, vehicle to world. Frames
/// have the names of their images.
std::vector<ImportedCamera> of_frames(const ImportedCamera& lens, const NamedText& poses,
                                      const NamedText& rig, const std::string& name) {
  const ExactPose to_camera = camera_from_vehicle(rig, name);
  std::vector<ImportedCamera> cameras;
  for (Line& line : lines_of(poses.text, poses.name)) {
    const auto frame = read_integer<std::uint64_t>(line, "the number of a frame");
    cameras.push_back(imported_camera(fmt::format("{:010}", frame), line.where, [&](auto& one) {
      one = lens;
      if (!one.fault.empty()) return;
      const Pose world_from_vehicle = pose_of_numbers(rest_of(line), line.where);
      one.camera.world_to_camera =
          rounded_pose(composed(to_camera, exact_inverse(world_from_vehicle, line.where)));
    }));
  }
  if (cameras.empty()) throw InputError(poses.name + ": holds no pose");
  require_different_names(cameras, poses.name);
  return cameras;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_kitti360(const NamedText& json, const GivenLens& given,
                                                   const std::optional<NamedText>& poses,
                                                   const std::optional<NamedText>& rig) {
  if (poses.has_value() != rig.has_value())
    throw UsageError("the poses of KITTI-360's vehicle and of its cameras go together");
  const text::JsonDocument document(json.text, json.name);
  const JsonValue root = document.root();
  const auto named = root.find("camera_name");
  const std::string name = named ? named->string() : stem_of(json.name);
  const auto camera = imported_camera(name, json.name, [&](ImportedCamera& one) {
    set_image(one.camera, given, [&] {
      return std::array{root.at("image_width"), root.at("image_height")};
    });
    read_mei(root, one);
  });
  if (!poses) return {camera};
  return of_frames(camera, *poses, *rig, name);
}

std::vector<ImportedCamera> cameras_of_kitti360(std::string_view json, const std::string& file,
                                                const GivenLens& given,
                                                const std::optional<Kitti360Poses>& poses) {
  const StandardArithmetic standard;
  if (!poses) return parse_kitti360({json, file}, given, std::nullopt, std::nullopt);
  const files::InputFile vehicle(poses->vehicle), rig(poses->rig);
  return parse_kitti360({json, file}, given, NamedText{vehicle.text(), poses->vehicle.string()},
                        NamedText{rig.text(), poses->rig.string()});
}

}  // namespace fathom
