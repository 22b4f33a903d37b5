#pragma once

#include <array>
#include <cstdint>

#include "fathom/mesh/mesh.h"

/// What meshes are put together from.
namespace fathom::bench {

using Vector3 = std::array<double, 3>;

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator*(double k, const Vector3& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
Vector3 cross(const Vector3& a, const Vector3& b);
Vector3 unit(const Vector3& a);

/// Two unit vectors at right angles to each other and to `axis`; axis, u, v is right-handed.
struct Across {
  Vector3 u, v;
};
Across across(const Vector3& axis);

/// The number of the new vertex.
std::uint32_t add_vertex(Mesh& mesh, const Vector3& p);

/// Two triangles: corner, corner + a, corner + a + b, corner + b; facing a × b.
void add_parallelogram(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b);

/// A box with the edges a, b, c from `corner`, twelve triangles that face outwards if a × b·c > 0.
void add_box(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b,
             const Vector3& c);

/// The side of a prism or frustum from one circle to another, `sides` quads as long as it, facing
/// outwards.
void add_tube(Mesh& mesh, const Vector3& from, double from_radius, const Vector3& to,
              double to_radius, std::uint32_t sides);

/// A convex polygon of the last `corners` vertices of the mesh, as a fan from the first of them.
void add_fan(Mesh& mesh, std::uint32_t corners);

}  // namespace fathom::bench
