#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "fathom/camera/point_frame.h"
#include "fathom/image/convert.h"

namespace fathom {

/// One point for each pixel that shows a surface at a finite depth, row by row. In the world frame,
/// the map's own P channels are used as they are if it has them, since they are exact numbers
/// rounded once; otherwise points come from `Z` (or `distance`) by point_at() and camera_to_world()
/// in binary64.
/// Unit     scene units.
/// Fails    InputError if the map or the camera has a fault; UsageError if there is no Z, distance
///          or P.
std::vector<std::array<double, 3>> points_of(const DepthMap& map, const Camera& camera,
                                             PointFrame frame);

struct PointCloudOptions {
  PointFrame frame = PointFrame::world;
  /// Coordinates as `double` (default) or as `float`.
  bool binary64 = true;
};

/// Writes points_of() as PLY, binary little endian: x y z; nx ny nz (float) where the map has N;
/// id, face, object (uint) where it has them. Normals are the map's own (world); for the camera
/// frame they are transformed by the inverse transpose and normalised again.
/// Fails    as points_of(); OutputError: "PATH: why".
void write_point_cloud(const DepthMap& map, const Camera& camera, const std::filesystem::path& path,
                       const PointCloudOptions& options = {});

}  // namespace fathom
