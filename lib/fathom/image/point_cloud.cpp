#include "fathom/image/point_cloud.h"

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace files;

namespace {

using Vector = std::array<double, 3>;

using Rows34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// Summed from the left.
Vector transform_point(const Pose& m, const Vector& p) {
  const Eigen::Map<const Rows34> M(m.front().data());
  const Eigen::Vector3d moved = M.col(0) * p[0] + M.col(1) * p[1] + M.col(2) * p[2] + M.col(3);
  return {moved.x(), moved.y(), moved.z()};
}

/// The three channels `GROUP.X`, `GROUP.Y`, `GROUP.Z`, if the map has them all.
struct Triple {
  std::array<const Samples<float>*, 3> parts{};
  Triple(const DepthMap& map, const std::string& group) {
    for (std::size_t k = 0; k < 3; ++k)
      parts[k] = map.values<float>(group + "." + std::string(1, "XYZ"[k]));
  }
  explicit operator bool() const { return parts[0] && parts[1] && parts[2]; }
  Vector operator[](std::size_t k) const {
    return {(*parts[0])[k], (*parts[1])[k], (*parts[2])[k]};
  }
};

/// Points and normals need the pose. Points from depths also need rays, which must be straight.
void require_valid_pose(Camera camera) {
  camera.projection.lens.reset();
  require_valid(camera);
}

/// Where the points come from.
class Points {
 public:
  Points(const DepthMap& map, const Camera& camera, PointFrame frame)
      : map_(map), camera_(camera), frame_(frame), position_(map, "P"), normal_(map, "N") {
    world_from_camera_ = camera_to_world(camera.world_to_camera);
    if (position_) {
      source_ = map.find("P.X");
    } else {
      require_straight(camera, points_need_no_lens);
      source_ = map.find("Z");
      if (!source_) {
        source_ = map.find("distance");
        ray_distance_ = true;
      }
      if (!source_) throw UsageError("a point cloud needs a channel Z, distance or P");
      const DepthMap depth = with_storage(map, source_->name, StoredType::binary64);
      depth_ = *depth.values<double>(source_->name);
    }
    surface_ = surface_mask(map, *source_);
  }

  [[nodiscard]] bool has_normals() const { return static_cast<bool>(normal_); }

  [[nodiscard]] std::optional<Vector> point(std::size_t k) const {
    if (!surface_[k]) return std::nullopt;
    const Vector p = position_ ? given_point(k) : computed_point(k);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return std::nullopt;
    return p;
  }

  [[nodiscard]] Vector normal(std::size_t k) const {
    const Vector n = normal_[k];
    if (frame_ == PointFrame::world) return n;
    // Normals transform by the inverse transpose.
    const Eigen::Map<const Rows34> world_from_camera(world_from_camera_.front().data());
    Eigen::Vector3d turned =
        world_from_camera.leftCols<3>().transpose() * Eigen::Vector3d(n.data());
    const double length = turned.stableNorm();
    if (length > 0) turned /= length;
    return {turned.x(), turned.y(), turned.z()};
  }

 private:
  [[nodiscard]] Vector given_point(std::size_t k) const {
    return frame_ == PointFrame::world ? position_[k]
                                       : transform_point(camera_.world_to_camera, position_[k]);
  }

  [[nodiscard]] Vector computed_point(std::size_t k) const {
    const std::size_t column = k % map_.width, row = k / map_.width;
    const auto i = static_cast<double>(column), j = static_cast<double>(row);
    double z = depth_[k];
    if (ray_distance_ && is_perspective(camera_.projection)) {
      const Vector ray = point_at(camera_, i, j, 1);
      z /= std::hypot(ray[0], ray[1], ray[2]);
    }
    const Vector p = point_at(camera_, i, j, z);
    return frame_ == PointFrame::world ? transform_point(world_from_camera_, p) : p;
  }

  const DepthMap& map_;
  const Camera& camera_;
  PointFrame frame_;
  Triple position_, normal_;
  Pose world_from_camera_{};
  const ImageChannel* source_ = nullptr;
  bool ray_distance_ = false;
  Samples<double> depth_;
  std::vector<std::uint8_t> surface_;
};

std::string header_of(std::size_t points, const PointCloudOptions& options, bool has_normals,
                      const std::vector<std::string>& identifiers) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += options.frame == PointFrame::world ? "comment world frame\n"
                                             : "comment camera frame: x right, y down, z forward\n";
  text += "element vertex " + std::to_string(points) + "\n";
  for (const char* axis : {"x", "y", "z"})
    text += std::string("property ") + (options.binary64 ? "double " : "float ") + axis + "\n";
  if (has_normals)
    for (const char* axis : {"nx", "ny", "nz"})
      text += std::string("property float ") + axis + "\n";
  for (const std::string& name : identifiers) text += "property uint " + name + "\n";
  return text + "end_header\n";
}

}  // namespace

std::vector<std::array<double, 3>> points_of(const DepthMap& map, const Camera& camera,
                                             PointFrame frame) {
  const StandardArithmetic standard;
  require_valid(map);
  require_valid_pose(camera);
  const Points points(map, camera, frame);
  std::vector<Vector> all;
  for (std::size_t k = 0; k < std::size_t{map.width} * map.height; ++k)
    if (const std::optional<Vector> p = points.point(k)) all.push_back(*p);
  return all;
}

void PointCloud::add(const DepthMap& map, const Camera& camera, const std::string& name) {
  const StandardArithmetic standard;
  require_valid(map);
  require_valid_pose(camera);
  const Points points(map, camera, options_.frame);
  std::vector<std::string> identifiers;
  for (const char* each : {"id", "face", "object"})
    if (map.values<std::uint32_t>(each)) identifiers.emplace_back(each);
  if (maps_ == 0) {
    has_normals_ = points.has_normals();
    identifiers_ = std::move(identifiers);
  } else if (has_normals_ != points.has_normals() || identifiers_ != identifiers) {
    throw UsageError(name + ": the maps of a cloud need the same of N, id, face and object");
  }
  for (std::size_t k = 0; k < std::size_t{map.width} * map.height; ++k) {
    const std::optional<Vector> p = points.point(k);
    if (!p) continue;
    ++points_;
    for (const double x : *p)
      options_.binary64 ? put_number(body_, x) : put_number(body_, static_cast<float>(x));
    if (has_normals_)
      for (const double x : points.normal(k)) put_number(body_, static_cast<float>(x));
    for (const std::string& each : identifiers_)
      put_number(body_, (*map.values<std::uint32_t>(each))[k]);
    if (options_.numbers_views) put_number(body_, maps_);
  }
  ++maps_;
}

std::vector<std::byte> PointCloud::encode() const {
  std::vector<std::string> numbers = identifiers_;
  if (options_.numbers_views) numbers.emplace_back("view");
  Bytes file;
  append(file, header_of(points_, options_, has_normals_, numbers));
  append(file, body_);
  return file;
}

void write_point_cloud(const DepthMap& map, const Camera& camera, const std::filesystem::path& path,
                       const PointCloudOptions& options) {
  const StandardArithmetic standard;
  PointCloud cloud(options);
  cloud.add(map, camera, path.string());
  write_file(path, cloud.encode());
}

}  // namespace fathom
