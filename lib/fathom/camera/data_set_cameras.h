#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera_import.h"

/// The cameras of data sets in their published layouts, and of calibrations; docs/data-sets.md has
/// the conventions and their sources. The rules of camera_import.h apply: exact rationals, rounded
/// once; the fault of a single camera is stored with that camera.
///
/// All fail with InputError, one line that names the file and the line or key, if the files as a
/// whole are invalid or two images have the same name.
namespace fathom {

/// Which way a matrix leads.
enum class PoseDirection { world_to_camera, camera_to_world };

/// x right in both; y down and z forward (OpenCV), or y up and z backward (OpenGL).
enum class CameraAxes { opencv, opengl };

/// Conventions that a list of matrices does not contain.
struct MatrixConvention {
  PoseDirection direction;
  CameraAxes axes;
  /// The image coordinate of the first pixel's centre as K counts: 0 or ½.
  double pixel_centre;
};

/// [fx s cx; 0 fy cy; 0 0 1], row by row, in pixels.
using IntrinsicMatrix = std::array<double, 9>;

/// Values from the caller that replace values of the data set.
struct GivenLens {
  /// Of the images, in pixels; 0: as the data set has it.
  std::uint32_t width = 0, height = 0;
  std::optional<IntrinsicMatrix> K;
  std::optional<double> pixel_centre;
};

/// A pose with its image's name: 3×4, [A | b].
struct NamedPose {
  std::string name;
  Pose pose{};
};

/// K and poses at hand, in the order of the poses: one K for all of them, or one for each.
/// `input` begins messages.
/// Fails    InputError if there is neither one K nor one for each pose.
std::vector<ImportedCamera> import_matrices(const std::vector<NamedPose>& poses,
                                            const std::vector<IntrinsicMatrix>& K,
                                            const MatrixConvention& convention, std::uint32_t width,
                                            std::uint32_t height, const std::string& input);

/// Poses as text. A file holds one matrix of 3 or 4 rows of 4 numbers and is called by its stem, or
/// has a matrix of 12 or 16 numbers on each line, which are called "0", "1", …. Of a folder, all
/// *.txt in the order of their names. Numbers may have commas between them.
std::vector<NamedPose> read_poses(const std::filesystem::path& file_or_folder);

/// K as text: 3 rows of 3 numbers, or, of each camera, a line of 9.
std::vector<IntrinsicMatrix> read_intrinsic_matrices(const std::filesystem::path& file);

/// Poses of the TUM RGB-D benchmark: a trajectory, "time tx ty tz qx qy qz qw" on each line, or the
/// folder with its groundtruth.txt. Camera to world, in metres. Cameras are named by the times in
/// the file. With a list of images (rgb.txt, depth.txt: "time file") they are named by the image
/// files, and each gets the pose nearest in time; images without a pose within 0.02 s are absent.
/// `lens` is from tum_lens() or from the caller (default 640×480 and pixel centre 0).
std::vector<ImportedCamera> import_tum(const std::filesystem::path& trajectory,
                                       const std::optional<std::filesystem::path>& images,
                                       const ImportedCamera& lens);

/// The published lenses of TUM's Kinects by name: "ros" (for the registered depth images),
/// "freiburg1", "freiburg2", "freiburg3"; freiburg1 and freiburg2 have distortion. Nothing for
/// another name.
std::optional<ImportedCamera> tum_lens(const std::string& name);
/// A given lens in their place. Fails    UsageError if `given` has no K.
ImportedCamera tum_lens(const GivenLens& given);

/// 7-Scenes: a folder of frame-XXXXXX.pose.txt, in the order of their names and called
/// "frame-XXXXXX". Camera to world, in metres. Where nothing else is given: 640×480, fx = fy = 585,
/// (320, 240), pixel centre 0.
std::vector<ImportedCamera> import_7scenes(const std::filesystem::path& folder,
                                           const GivenLens& given);

/// ScanNet's two streams.
enum class ScanNetStream { depth, colour };

/// ScanNet: a folder with pose/N.txt and intrinsic/intrinsic_depth.txt or intrinsic_color.txt, in
/// the order of N, which is the name. Camera to world, in metres; frames with a pose of -inf are
/// absent. Where nothing else is given: 640×480 or 1296×968, pixel centre 0.
std::vector<ImportedCamera> import_scannet(const std::filesystem::path& folder,
                                           ScanNetStream stream, const GivenLens& given);

/// ScanNet++'s iphone/pose_intrinsic_imu.json, in the order of its frames: aligned_pose, camera to
/// world with OpenCV's axes, in metres, and intrinsic. Where nothing else is given: 1920×1440, the
/// video, and pixel centre 0.
std::vector<ImportedCamera> import_scannetpp(const std::filesystem::path& file,
                                             const GivenLens& given);

/// Replica as rendered for iMAP and NICE-SLAM: a folder with traj.txt, a 4×4 matrix on each line,
/// camera to world, in metres; and, next to it or in the folder above, cam_params.json. Named
/// "frame000000", …. The default pixel centre is 0.
std::vector<ImportedCamera> import_replica(const std::filesystem::path& folder,
                                           const GivenLens& given);

/// KITTI's rectified cameras, from calib.txt (odometry: P0 to P3) or calib_cam_to_cam.txt (raw:
/// P_rect_00 to P_rect_03 and their sizes S_rect). P = K·[I | t], so camera i is displaced from
/// camera 0 by t, in metres.
/// Without poses, returns these cameras in the frame of rectified camera 0, named "image_0" or
/// "image_00" like their folders. With poses (3×4 on each line: camera 0 to world), returns camera
/// `number` of each frame, named "000000", …. The default pixel centre is 0.
/// Fails    UsageError if the image size is neither given nor in the file, or if there are poses
///          but no number.
std::vector<ImportedCamera> import_kitti(const std::filesystem::path& calibration,
                                         const std::optional<std::filesystem::path>& poses,
                                         std::optional<std::uint32_t> number,
                                         const GivenLens& given);

/// AliceVision's (Meshroom's) sfmData as JSON (.sfm, .json), of version 1.0 to 1.2, in the order of
/// its views, named by their paths below the common folder. Views without a pose are absent; views
/// of rigs and of lenses without a pinhole part have a fault. Pixel centre 0.
std::vector<ImportedCamera> import_sfm_data(const std::filesystem::path& file);

// Calibrations: intrinsics and distortion of one camera, without a pose. The texts are JSON, which
// the program makes from YAML. `file` begins messages, and its stem is the name of a camera without
// a pose. `given` replaces the size of the image and the pixel centre, 0; its K is not used.

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

/// Kalibr's camera chain: cam0, cam1, … with camera_model (pinhole, omni, eucm, ds), intrinsics,
/// distortion_model (none, radtan, equidistant, fov), distortion_coeffs, resolution and T_cn_cnm1,
/// the pose of each camera from the frame of the previous one. The frame of cam0 is the world, and
/// the cameras have the names of their keys; `poses` are of cam0, and camera N of a pose is called
/// "camN/POSE". Each entry of the product of poses is the exact one, rounded once.
std::vector<ImportedCamera> cameras_of_kalibr(std::string_view json, const std::string& file,
                                              const GivenLens& given,
                                              const CalibrationPoses& poses = {});

/// Project Aria's calibration: CameraCalibrations, each with Label, Projection
/// (FisheyeRadTanThinPrism or KannalaBrandtK3), T_Device_Camera and ConfigData or, for all,
/// ImageSizes. The device is the world, in metres; `poses` are of the device. The lens ends at
/// MaxSolidAngle. Without ConfigData and ImageSizes the image's size must be given.
std::vector<ImportedCamera> cameras_of_aria(std::string_view json, const std::string& file,
                                            const GivenLens& given,
                                            const CalibrationPoses& poses = {});

/// The poses of a drive of KITTI-360.
struct Kitti360Poses {
  /// poses.txt: a frame's number and 12 numbers on each line, vehicle to world.
  std::filesystem::path vehicle;
  /// calib_cam_to_pose.txt: "image_02: " and 12 numbers on a line, camera to vehicle.
  std::filesystem::path rig;
};

/// A fisheye of KITTI-360 (image_02.yaml, image_03.yaml): the model MEI of camodocal, with
/// mirror_parameters, distortion_parameters and projection_parameters. With poses there is a camera
/// for each frame, called "0000000250", …, in metres; each entry of the inverse of the product of
/// the two poses is the exact one, rounded once. The default pixel centre is 0.
std::vector<ImportedCamera> cameras_of_kitti360(std::string_view json, const std::string& file,
                                                const GivenLens& given,
                                                const std::optional<Kitti360Poses>& poses = {});

}  // namespace fathom
