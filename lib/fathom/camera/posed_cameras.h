#pragma once

#include <string>
#include <vector>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/rounded_poses.h"

/// From a lens and the poses of a data set to its cameras: what all layouts share. Only for .cpp
/// files of this room.
/// Fails    InputError, beginning with `where`.
namespace fathom::camera {

/// fx s cx, 0 fy cy, 0 0 1.
void set_intrinsics(Projection& projection, const IntrinsicMatrix& K, const std::string& where);

/// The intrinsic matrix of four numbers.
IntrinsicMatrix intrinsic_matrix(double fx, double fy, double cx, double cy);

/// A camera at the world's origin from the caller's values and, for the rest, the data set's
/// values. An unknown size is 0.
Camera lens_of(const GivenLens& given, const GivenLens& data_set, const std::string& where);

/// World to camera, in our axes, of a pose [A | b]: exact, or each entry of the inverse rounded
/// once. Fails where an entry is not finite, and where a pose that has to be inverted is singular.
Pose camera_from_world(const Pose& pose, PoseDirection direction, CameraAxes axes,
                       const std::string& where);

/// A lens with a pose; a fault of either is the camera's fault.
ImportedCamera placed(const ImportedCamera& lens, const NamedPose& pose, PoseDirection direction,
                      CameraAxes axes, const std::string& where);

/// Refuses two images of one name.
void require_different_names(const std::vector<ImportedCamera>& cameras, const std::string& input);

/// A matrix of 3 or 4 rows by 4, in order; the last of four has to be 0 0 0 1. Entries that are not
/// finite are let through.
Pose pose_of_numbers(const std::vector<double>& numbers, const std::string& where);

/// A text with one matrix of 3 or 4 lines of 4 numbers. `name` is the file's.
Pose parse_pose(std::string_view text, const std::string& name);

/// The files of a folder whose names end with `suffix`, by name. Fails if there is no such file.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder,
                                            const std::string& suffix);

}  // namespace fathom::camera
