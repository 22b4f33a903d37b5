#include "fathom/pipeline/geometry/surface_motion.h"

#include <algorithm>

#include "fathom/numeric/rounding.h"

namespace fathom::pipeline {
namespace {

using ImageRows = std::array<std::array<double, 4>, 3>;

/// (U, V, W) of points in the camera frame.
ImageRows image_from_camera(const Camera& camera) {
  const PrincipalPoint centre = principal_point(camera);
  if (camera.projection == Projection::perspective) {
    return {{{camera.fx, camera.skew, centre.x, 0}, {0, camera.fy, centre.y, 0}, {0, 0, 1, 0}}};
  }
  return {{{camera.fx, camera.skew, 0, centre.x}, {0, camera.fy, 0, centre.y}, {0, 0, 0, 1}}};
}

ImageRows composed(const ImageRows& a, const ImageRows& b) {
  ImageRows c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 0; j < 3; ++j) c[i][k] += a[i][j] * b[j][k];
    }
    c[i][3] += a[i][3];
  }
  return c;
}

ImageRows world_to_camera(const Camera& camera) {
  ImageRows rows{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) rows[i][k] = camera.world_to_camera[i][k];
  return rows;
}

ImageRows world_from_mesh(const Object& object) {
  ImageRows rows{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      rows[i][k] = round_to_binary64(object.world_from_mesh.rows[i][k]);
  return rows;
}

/// The line through two points of the image, homogeneous.
std::array<double, 3> line_through(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

ImageTriangles::ImageTriangles(const Scene& scene, const Camera& camera)
    : first_{0}, scene_(&scene) {
  const ImageRows view = composed(image_from_camera(camera), world_to_camera(camera));
  for (const Object& object : scene.objects) {
    image_from_mesh_.push_back(composed(view, world_from_mesh(object)));
    first_.push_back(first_.back() +
                     static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size()));
  }
}

ImageTriangle ImageTriangles::operator[](std::uint32_t number) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  const auto object = static_cast<std::size_t>(after - first_.begin()) - 1;
  const Mesh& mesh = scene_->meshes[scene_->objects[object].mesh];
  const ImageRows& m = image_from_mesh_[object];
  ImageTriangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint& p = mesh.vertices[mesh.triangles[number - first_[object]][k]];
    for (std::size_t i = 0; i < 3; ++i)
      triangle[k][i] = m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3];
  }
  return triangle;
}

// (u, v, 1) is Σ βₖ·cornerₖ up to a factor; by Cramer's rule βₖ is (u, v, 1) · (the line through the
// other two corners), up to the same factor.
std::optional<std::array<double, 3>> weights_at(const ImageTriangle& triangle, double u, double v) {
  std::array<double, 3> weights{};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto normal = line_through(triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
    weights[k] = normal[0] * u + normal[1] * v + normal[2];
    sum += weights[k];
  }
  if (sum == 0) return std::nullopt;
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::optional<std::array<double, 2>> place_of(const ImageTriangle& triangle,
                                              const std::array<double, 3>& weights) {
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) point[i] += weights[k] * triangle[k][i];
  if (!(point[2] > 0)) return std::nullopt;
  return std::array<double, 2>{point[0] / point[2], point[1] / point[2]};
}

}  // namespace fathom::pipeline
