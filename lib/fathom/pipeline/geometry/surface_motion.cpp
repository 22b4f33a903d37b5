#include "fathom/pipeline/geometry/surface_motion.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "fathom/geometry/eigen_arrays.h"

namespace fathom::pipeline {
namespace {

using geometry::as_array;
using geometry::as_matrix;
using geometry::as_vector;

/// An affine map of points, or a projection of them to (U, V, W).
using Map34 = geometry::RowMatrix<double, 3, 4>;

/// (U, V, W) of points in the camera frame.
Map34 image_from_camera(const Projection& projection) {
  const auto [cx, cy] = principal_point(projection);
  const Eigen::Vector3d centre(cx, cy, 1);
  Map34 m = Map34::Zero();
  m.row(0).head<2>() << projection.fx, projection.skew;
  m(1, 1) = projection.fy;
  m.col(is_perspective(projection) ? 2 : 3) = centre;
  return m;
}

/// The map that applies `b`, which is affine, then `a`.
Map34 composed(const Map34& a, const Map34& b) {
  Map34 c = a.leftCols<3>() * b;
  c.col(3) += a.col(3);
  return c;
}

}  // namespace

ImageTriangles::ImageTriangles(const Scene& scene, const Camera& camera)
    : first_{0}, scene_(&scene) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Map34 image_from_world = composed(image_from_camera(camera.projection), camera_from_world);
  for (const Object& object : scene.objects) {
    as_matrix(image_from_mesh_.emplace_back()) =
        composed(image_from_world, geometry::rounded(object.world_from_mesh));
    first_.push_back(first_.back() +
                     static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size()));
  }
}

ImageTriangle ImageTriangles::operator[](std::uint32_t number) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  const auto object = static_cast<std::size_t>(after - first_.begin()) - 1;
  const Mesh& mesh = scene_->meshes[scene_->objects[object].mesh];
  const auto image_from_mesh = as_matrix(image_from_mesh_[object]);
  ImageTriangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint& p = mesh.vertices[mesh.triangles[number - first_[object]][k]];
    triangle[k] = as_array(image_from_mesh * Eigen::Vector4d(p.x, p.y, p.z, 1));
  }
  return triangle;
}

// (u, v, 1) is Σ βₖ·cornerₖ up to a factor; by Cramer's rule βₖ is (u, v, 1) · (the line through
// the other two corners), up to the same factor.
std::optional<std::array<double, 3>> weights_at(const ImageTriangle& triangle, double u, double v) {
  const Eigen::Vector3d a = as_vector(triangle[0]), b = as_vector(triangle[1]),
                        c = as_vector(triangle[2]), p(u, v, 1);
  const Eigen::Vector3d weights(b.cross(c).dot(p), c.cross(a).dot(p), a.cross(b).dot(p));
  const double sum = weights.sum();
  if (sum == 0) return std::nullopt;
  return as_array(weights / sum);
}

std::optional<std::array<double, 2>> place_of(const ImageTriangle& triangle,
                                              const std::array<double, 3>& weights) {
  const Eigen::Vector3d point = as_matrix(triangle).transpose() * as_vector(weights);
  if (!(point.z() > 0)) return std::nullopt;
  return std::array<double, 2>{point.x() / point.z(), point.y() / point.z()};
}

}  // namespace fathom::pipeline
