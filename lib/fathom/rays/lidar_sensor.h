#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/pose.h"

namespace fathom {

/// A rotating lidar: beams of fixed altitude and azimuth, which measure together once for each
/// column while the head turns clockwise, as seen from above.
///
/// Frame    lidar: x towards column 0, z up, along the axis. Lengths are in millimetres, angles in
///          degrees, as in the file.
/// Exact    every number is the real number that it denotes.
struct LidarSensor {
  /// Beams from the top, and columns of a turn.
  std::uint32_t rows = 0, columns = 0;
  /// For each beam.
  std::vector<double> altitudes, azimuths;
  /// Where beams begin: so far from the axis, in the direction of the head, and so high.
  double beam_radius = 0, beam_height = 0;
  Pose lidar_to_sensor{};
  /// For each beam, the number of columns by which its row is moved to the right in an image in
  /// which neighbours in a column have nearly the same azimuth; empty if the file has none.
  std::vector<std::int32_t> shifts;
  /// Turns in a second, if the file has them.
  std::optional<std::uint32_t> turns_per_second;
  /// The file, for messages.
  std::string name;
};

/// Reads the metadata of an Ouster sensor, JSON: as the sensor's HTTP interface or the SDK write
/// it, with keys in groups (beam_intrinsics, lidar_intrinsics, lidar_data_format, config_params) or
/// without.
/// Fails    InputError "FILE: KEY: …": a key that is missing, a list of another length, a matrix
///          that is not rigid.
LidarSensor read_ouster_sensor(const std::filesystem::path& file);

}  // namespace fathom
