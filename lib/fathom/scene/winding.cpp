#include "fathom/scene/winding.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>

#include "fathom/scene/element_checks.h"
#include "fathom/scene/sight.h"
#include "fathom/threads/threads.h"

namespace fathom::scene {
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
/// z growing or falling. An edge gives the same answer, but for the sign, from both of its ends: a
/// ray through it meets exactly one of its two triangles.
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
