#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/pose.h"
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

/// Why points_of() refuses a camera whose lens bends rays, unless the map has P.
inline constexpr std::string_view points_need_no_lens =
    "a map is not unprojected with it: render with channels Z and P ('fathom render --channels "
    "Z,P'), and make the points of that map";

struct PointCloudOptions {
  PointFrame frame = PointFrame::world;
  /// Coordinates as `double` (default) or as `float`.
  bool binary64 = true;
  /// Whether each point has the number of its map, `view` (uint), after all else.
  bool numbers_views = false;
};

/// A cloud of the points of one map or of several, one after the other. A point that several maps
/// show is there several times.
class PointCloud {
 public:
  explicit PointCloud(const PointCloudOptions& options) : options_(options) {}

  /// Adds points_of(). `name` is the map's for messages.
  /// Fails    as points_of(); UsageError if the maps before have other normals or identifiers.
  void add(const DepthMap& map, const Camera& camera, const std::string& name);
  /// The file, as of write_point_cloud().
  [[nodiscard]] std::vector<std::byte> encode() const;

 private:
  PointCloudOptions options_;
  bool has_normals_ = false;
  std::vector<std::string> identifiers_;
  std::vector<std::byte> body_;
  std::size_t points_ = 0;
  std::uint32_t maps_ = 0;
};

/// Writes points_of() as PLY, binary little endian: x y z; nx ny nz (float) where the map has N;
/// id, face, object (uint) where it has them. Normals are the map's own (world); for the camera
/// frame they are transformed by the inverse transpose and normalised again.
/// Fails    as points_of(); OutputError: "PATH: why".
void write_point_cloud(const DepthMap& map, const Camera& camera, const std::filesystem::path& path,
                       const PointCloudOptions& options = {});

}  // namespace fathom
