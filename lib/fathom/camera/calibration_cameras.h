#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/data_set_cameras.h"

/// Cameras of calibrations: intrinsics and distortion of one camera, without a pose. The texts are
/// JSON; the program makes it of YAML. The rules of camera_import.h apply.
///
/// `file` begins messages, and its stem is the name of a camera without a pose. `given` replaces
/// the size of the image and the pixel centre, 0; its K is not used.
///
/// All fail with InputError, one line that names the file and the key.
namespace fathom {

/// The poses of a calibrated camera, in OpenCV's axes.
struct CalibrationPoses {
  /// There is a camera for each. Without poses there is one, whose frame is the world.
  std::vector<NamedPose> poses;
  PoseDirection direction = PoseDirection::world_to_camera;
};

/// OpenCV's FileStorage, as its calibration programs write it: camera_matrix (or cameraMatrix, K),
/// distortion_coefficients (or distCoeffs, dist_coeffs, D) with 4, 5, 8, 12 or 14 numbers, and
/// image_width and image_height. A matrix has rows, cols and data, or is a list. The lens is
/// OPENCV_14, or a pinhole where all numbers are 0. A calibration of OpenCV's fisheye model
/// ("fisheye_model: 1") has distortion that is not available.
std::vector<ImportedCamera> cameras_of_opencv(std::string_view json, const std::string& file,
                                              const GivenLens& given,
                                              const CalibrationPoses& poses = {});

/// ROS's camera_info: the file of camera_calibration, or a message (width, height, K, D in ROS 1;
/// k, d in ROS 2). The distortion_model plumb_bob has 4 or 5 numbers, rational_polynomial 8, 12 or
/// 14; equidistant is not available. Binning and regions of interest are not applied.
std::vector<ImportedCamera> cameras_of_ros(std::string_view json, const std::string& file,
                                           const GivenLens& given,
                                           const CalibrationPoses& poses = {});

}  // namespace fathom
