#include "tests/oracle/smooth_normals.h"

namespace fathom::oracle {
namespace {

Vector cross_of(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Q dot_of(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector sum_around(const SmoothMesh& mesh, std::uint32_t vertex) {
  Vector sum;
  for (const auto& t : mesh.triangles) {
    const auto& A = mesh.vertices[t[0]];
    Vector p, r;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.vertices[t[1]][i] - A[i];
      r[i] = mesh.vertices[t[2]][i] - A[i];
    }
    for (const std::uint32_t v : t) {
      const bool same = mesh.by_place ? mesh.vertices[v] == mesh.vertices[vertex] : v == vertex;
      if (!same) continue;
      const Vector n = cross_of(p, r);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += n[i];
    }
  }
  return sum;
}

/// The x with Mᵀx = n, by Cramer's rule; where M is singular, what the plane of a triangle with the
/// normal n is taken to.
Vector placed(const Linear& m, const Vector& n) {
  // Row i of Mᵀ is column i of M.
  const Q det = dot_of(m[0], cross_of(m[1], m[2]));
  const Vector x{dot_of(n, cross_of(m[1], m[2])), dot_of(n, cross_of(m[2], m[0])),
                 dot_of(n, cross_of(m[0], m[1]))};
  if (sgn(det) == 0) return x;
  return {x[0] / det, x[1] / det, x[2] / det};
}

}  // namespace

Vector corner_normal(const SmoothMesh& mesh, const Linear& placement, std::uint32_t triangle,
                     std::size_t corner) {
  if (!mesh.normals.empty() && mesh.normals[triangle][corner])
    return placed(placement, *mesh.normals[triangle][corner]);
  return placed(placement, sum_around(mesh, mesh.triangles[triangle][corner]));
}

Vector smooth_normal(const SmoothMesh& mesh, const Linear& placement, std::uint32_t triangle,
                     const Q& weight_b, const Q& weight_c) {
  const Q weights[] = {1 - weight_b - weight_c, weight_b, weight_c};
  Vector sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector n = corner_normal(mesh, placement, triangle, k);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weights[k] * n[i];
  }
  return sum;
}

}  // namespace fathom::oracle
