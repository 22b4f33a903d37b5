#include "fathom/scene/sight.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>

#include "fathom/numeric/rounding.h"
#include "fathom/scene/element_checks.h"
#include "fathom/threads/threads.h"

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

namespace {

Vector from(const Vector& eye, const MeshPoint& p) {
  return {p.x - eye[0], p.y - eye[1], p.z - eye[2]};
}

double inner(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double volume(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// ±1 where the edge from p to q, seen along x, passes the height of the origin on its right, with
/// z growing or falling. The answers for an edge and its reverse differ only in sign: a ray through
/// the edge meets exactly one of its two triangles.
int passes(const Vector& p, const Vector& q) {
  const bool p_is_low = p[2] <= 0, q_is_low = q[2] <= 0;
  if (p_is_low == q_is_low) return 0;
  const Vector& low = p_is_low ? p : q;
  const Vector& high = p_is_low ? q : p;
  const bool on_the_right = low[1] * (high[2] - low[2]) - low[2] * (high[1] - low[1]) > 0;
  if (!on_the_right) return 0;
  return p_is_low ? 1 : -1;
}

int crossings_of(const Mesh& mesh, std::span<const CornerIndices> triangles, const Vector& eye) {
  if (!all_below(triangles, mesh.vertices.size())) throw ElementFault();
  int sum = 0;
  const std::span<const MeshPoint> vertices(mesh.vertices);
  for (const auto& [i, j, k] : triangles) {
    const Vector a = from(eye, vertices[i]), b = from(eye, vertices[j]), c = from(eye, vertices[k]);
    const int turn = passes(a, b) + passes(b, c) + passes(c, a);
    // The triangle lies ahead on the ray if its plane turns the same way around eye and ray.
    if (turn != 0 && turn * volume(a, b, c) > 0) sum += turn;
  }
  return sum;
}

}  // namespace

double winding_number(const Mesh& mesh, const Vector& eye) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector a = from(eye, mesh.vertices[i]), b = from(eye, mesh.vertices[j]),
                 c = from(eye, mesh.vertices[k]);
    const double A = std::hypot(a[0], a[1], a[2]), B = std::hypot(b[0], b[1], b[2]),
                 C = std::hypot(c[0], c[1], c[2]);
    sum += 2 * std::atan2(volume(a, b, c),
                          A * B * C + inner(a, b) * C + inner(b, c) * A + inner(c, a) * B);
  }
  return sum / (4 * std::numbers::pi);
}

int crossings_along_x(const Mesh& mesh, const Vector& eye) {
  constexpr std::size_t part = 1U << 15;
  const std::span<const CornerIndices> all(mesh.triangles);
  const std::size_t parts = (all.size() + part - 1) / part;
  std::atomic<int> sum = 0;
  in_parallel(parts, [&](std::size_t i) {
    const std::size_t first = i * part;
    sum += crossings_of(mesh, all.subspan(first, std::min(part, all.size() - first)), eye);
  });
  return sum;
}

}  // namespace fathom::scene
