#include "fathom/camera/imports/calibrated_lens.h"

#include <algorithm>
#include <array>
#include <limits>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/lens.h"
#include "fathom/failures/errors.h"
#include "fathom/text/json_value.h"

namespace fathom::camera {

std::uint32_t pixels_of(const text::JsonValue& size) {
  return static_cast<std::uint32_t>(size.integer(1, std::numeric_limits<std::uint32_t>::max()));
}

void set_lens(ImportedCamera& one, std::string_view model, std::span<const LensNumber> numbers,
              const std::string& where) {
  const auto known = lens_model_named(model);
  if (!known) {
    one.absence = where + ": the lens model " + std::string(model) + " is not available";
    return;
  }
  Lens lens{*known};
  const auto parameters = entry_of(*known).distortion;
  for (const auto& [parameter, value] : numbers) {
    const auto place = std::ranges::find(parameters, parameter);
    if (place != parameters.end()) {
      lens.distortion.at(static_cast<std::size_t>(place - parameters.begin())) = value;
    } else if (value != 0) {
      one.absence = where + ": the lens model " + std::string(model) + " has no parameter " +
                    std::string(parameter);
      return;
    }
  }
  if (const auto fault = find_fault(lens)) throw InputError(where + ": " + *fault);
  if (!is_pinhole(lens)) one.camera.projection.lens = lens;
}

void set_fisheye624(ImportedCamera& one, std::span<const double> numbers,
                    const std::string& where) {
  constexpr std::array<std::string_view, fisheye624_numbers> parameters{
      "k0", "k1", "k2", "k3", "k4", "k5", "p0", "p1", "s0", "s1", "s2", "s3"};
  std::array<LensNumber, fisheye624_numbers> named;
  for (std::size_t i = 0; i < named.size(); ++i) named[i] = {parameters[i], numbers[i]};
  set_lens(one, "RAD_TAN_THIN_PRISM_FISHEYE", named, where);
}

std::vector<ImportedCamera> at_poses(const ImportedCamera& camera, const std::string& file,
                                     const CalibrationPoses& given) {
  if (given.poses.empty()) return {camera};
  std::vector<ImportedCamera> cameras;
  for (const NamedPose& pose : given.poses)
    cameras.push_back(placed(camera, pose, given.direction, CameraAxes::opencv, file));
  require_different_names(cameras, file);
  return cameras;
}

namespace {

/// A camera of a rig at a pose of the rig.
ImportedCamera placed(const RigCamera& part, const NamedPose& pose, PoseDirection direction,
                      const std::string& where) {
  const std::string& own = part.camera.camera.name;
  return imported_camera(
      pose.name.empty() ? own : own + "/" + pose.name, where, [&](ImportedCamera& one) {
        one = part.camera;
        if (!one.fault.empty()) return;
        const ExactPose rig_from_world = direction == PoseDirection::camera_to_world
                                             ? exact_inverse(pose.pose, where)
                                             : exact_pose(pose.pose, where);
        one.camera.world_to_camera = rounded_pose(composed(*part.from_rig, rig_from_world));
      });
}

}  // namespace

std::vector<ImportedCamera> at_poses(const std::vector<RigCamera>& rig, const std::string& file,
                                     const CalibrationPoses& given) {
  const std::vector<NamedPose> at_origin{{"", Camera().world_to_camera}};
  std::vector<ImportedCamera> cameras;
  for (const NamedPose& pose : given.poses.empty() ? at_origin : given.poses)
    for (const RigCamera& part : rig) cameras.push_back(placed(part, pose, given.direction, file));
  require_different_names(cameras, file);
  return cameras;
}

}  // namespace fathom::camera
