#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/camera/pose.h"
#include "fathom/text/json_value.h"

/// From the numbers of a calibration to a lens, and from a calibration to cameras at poses: shared
/// by the importers of calibrations. Only for .cpp files of this module.
namespace fathom::camera {

/// The width or height of an image.
/// Fails    InputError if it is not an integer from 1 to 2³² − 1.
std::uint32_t pixels_of(const text::JsonValue& size);

/// The image of a calibrated camera: the given size or, where it is 0, the width and height of the
/// file, which `size_in_file` returns as an array of two values; the given pixel centre or 0.
/// `size_in_file` is called only if it is needed.
template <class SizeInFile>
void set_image(Camera& camera, const GivenLens& given, const SizeInFile& size_in_file) {
  camera.width = given.width;
  camera.height = given.height;
  if (given.width == 0 || given.height == 0) {
    const std::array<text::JsonValue, 2> size = size_in_file();
    if (given.width == 0) camera.width = pixels_of(size[0]);
    if (given.height == 0) camera.height = pixels_of(size[1]);
  }
  camera.projection.pixel_centre = given.pixel_centre.value_or(0);
}

/// A number of distortion, by the name of its parameter in the table of lens models (lens.h).
struct LensNumber {
  std::string_view parameter;
  double value = 0;
};

/// Gives a camera the lens of this model with these numbers. Parameters without a number are 0. A
/// lens that bends no ray is left out. If the table has no such model, or a number other than 0 has
/// no parameter there, the camera is absent. `where` begins messages.
/// Fails    InputError if a number is out of the range of its parameter.
void set_lens(ImportedCamera& one, std::string_view model, std::span<const LensNumber> numbers,
              const std::string& where);

/// The numbers of Project Aria's lens after its focal lengths and principal point.
inline constexpr std::size_t fisheye624_numbers = 12;

/// set_lens() for Project Aria's lens (Fisheye624, FisheyeRadTanThinPrism): k0 to k5, p0, p1, s0 to
/// s3.
void set_fisheye624(ImportedCamera& one, std::span<const double> numbers, const std::string& where);

/// The calibrated camera at the world's origin, or at each of the poses.
/// Fails    InputError if two poses have the same name.
std::vector<ImportedCamera> at_poses(const ImportedCamera& camera, const std::string& file,
                                     const CalibrationPoses& given);

/// A camera of a rig: the camera without its pose, and its pose from the frame of the rig, which a
/// camera with a fault may lack.
struct RigCamera {
  ImportedCamera camera;
  std::optional<ExactPose> from_rig;
};

/// The cameras of a rig that stands at the world's origin, or at each of the poses, where camera A
/// of the pose B is called "A/B". Each entry of the product of two poses is the exact one, rounded
/// once. A fault of a pose is the fault of its cameras.
/// Fails    InputError if two cameras have the same name.
std::vector<ImportedCamera> at_poses(const std::vector<RigCamera>& rig, const std::string& file,
                                     const CalibrationPoses& given);

/// The name of a camera that its calibration does not name.
inline std::string stem_of(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

}  // namespace fathom::camera
