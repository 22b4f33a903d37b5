#include "fathom/scene/sight.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/rounding.h"

namespace fathom::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls `visit` with corners of the scene in the world, of every `step`-th triangle.
template <class Visit>
void visit_corners(const Scene& scene, std::size_t step, const Visit& visit) {
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const Pose placement = rounded_placement(object);
    const auto place = [&](double x, double y, double z) {
      visit(object.placed_as_is ? Vector{x, y, z} : applied(placement, {x, y, z}));
    };
    if (mesh.vertices.size() == 2) {
      const MeshPoint &a = mesh.vertices[0], &b = mesh.vertices[1];
      for (const double x : {a.x, b.x})
        for (const double y : {a.y, b.y})
          for (const double z : {a.z, b.z}) place(x, y, z);
      continue;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
      for (const std::uint32_t corner : mesh.triangles[t]) {
        const MeshPoint& p = mesh.vertices[corner];
        place(p.x, p.y, p.z);
      }
    }
  }
}

}  // namespace

Vector applied(const Pose& map, const Vector& X) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [x, y, z, t] = map[i];
    result[i] = x * X[0] + y * X[1] + z * X[2] + t;
  }
  return result;
}

Pose rounded_placement(const Object& object) {
  Pose placement;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      placement[i][k] = round_to_binary64(object.world_from_mesh.rows[i][k]);
  return placement;
}

Sight::Sight()
    : lower{infinity, infinity, infinity},
      upper{-infinity, -infinity, -infinity},
      least_depth(infinity),
      greatest_depth(-infinity),
      first{infinity, infinity},
      last{-infinity, -infinity} {}

Vector Sight::middle() const {
  Vector m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = lower[k] / 2 + upper[k] / 2;
  return m;
}

ApproximateCamera::ApproximateCamera(const Camera& camera, const Pose& pose, double scale)
    : camera_(camera), pose_(pose), projection_(camera.projection), scale_(scale) {}

Vector ApproximateCamera::camera_point(const Vector& X) const {
  return applied(pose_, {scale_ * X[0], scale_ * X[1], scale_ * X[2]});
}

double ApproximateCamera::distance_from_middle(const Vector& X) const {
  const Vector p = camera_point(X);
  if (!(p[2] > 0)) return infinity;
  const auto [u, v] = projection_.image_of(p);
  return std::max(std::abs(2 * u / camera_.width - 1), std::abs(2 * v / camera_.height - 1));
}

void ApproximateCamera::look_at(const Vector& X, Sight& sight) const {
  ++sight.points;
  for (std::size_t k = 0; k < 3; ++k) {
    sight.lower[k] = std::min(sight.lower[k], X[k]);
    sight.upper[k] = std::max(sight.upper[k], X[k]);
  }
  const Vector p = camera_point(X);
  sight.least_depth = std::min(sight.least_depth, p[2]);
  sight.greatest_depth = std::max(sight.greatest_depth, p[2]);
  if (!(p[2] > 0)) return;
  ++sight.in_front;
  const auto [u, v] = projection_.image_of(p);
  sight.first = {std::min(sight.first[0], u), std::min(sight.first[1], v)};
  sight.last = {std::max(sight.last[0], u), std::max(sight.last[1], v)};
  if (p[2] >= camera_.near && p[2] <= camera_.far && u >= 0 && u <= camera_.width && v >= 0 &&
      v <= camera_.height)
    ++sight.in_image;
}

Sight ApproximateCamera::sight_of(const Scene& scene, std::size_t step) const {
  Sight sight;
  visit_corners(scene, step, [&](const Vector& X) { look_at(X, sight); });
  return sight;
}

}  // namespace fathom::scene
