#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/camera/data_set_cameras.h"

/// From the numbers of a calibration to a lens, and from a calibration to cameras at poses: shared
/// by the importers of calibrations. Only for .cpp files of this module.
namespace fathom::camera {

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

/// The name of a camera that its calibration does not name.
inline std::string stem_of(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

}  // namespace fathom::camera
