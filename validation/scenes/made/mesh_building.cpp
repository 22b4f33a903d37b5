#include "validation/scenes/made/mesh_building.h"

#include <cmath>
#include <numbers>

namespace fathom::bench {

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 unit(const Vector3& a) {
  return 1 / std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * a;
}

Across across(const Vector3& axis) {
  const bool upright = std::abs(axis[1]) > std::abs(axis[0]);
  const Vector3 u = unit(cross(upright ? Vector3{1, 0, 0} : Vector3{0, 1, 0}, axis));
  return {u, unit(cross(axis, u))};
}

std::uint32_t add_vertex(Mesh& mesh, const Vector3& p) {
  mesh.vertices.push_back({p[0], p[1], p[2]});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_parallelogram(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b) {
  const std::uint32_t first = add_vertex(mesh, corner);
  add_vertex(mesh, corner + a);
  add_vertex(mesh, corner + a + b);
  add_vertex(mesh, corner + b);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b,
             const Vector3& c) {
  add_parallelogram(mesh, corner, b, a);
  add_parallelogram(mesh, corner + c, a, b);
  add_parallelogram(mesh, corner, c, b);
  add_parallelogram(mesh, corner + a, b, c);
  add_parallelogram(mesh, corner, a, c);
  add_parallelogram(mesh, corner + b, c, a);
}

void add_tube(Mesh& mesh, const Vector3& from, double from_radius, const Vector3& to,
              double to_radius, std::uint32_t sides) {
  const auto [u, v] = across(unit(to + -1.0 * from));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const Vector3 out = std::cos(angle) * u + std::sin(angle) * v;
    add_vertex(mesh, from + from_radius * out);
    add_vertex(mesh, to + to_radius * out);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
  }
}

void add_fan(Mesh& mesh, std::uint32_t corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size()) - corners;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) {
    mesh.triangles.push_back({first, first + i, first + i + 1});
  }
}

}  // namespace fathom::bench
