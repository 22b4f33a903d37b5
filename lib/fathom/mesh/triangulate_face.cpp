#include "fathom/mesh/triangulate_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fathom/mesh/ear_clipping.h"
#include "fathom/mesh/planar_ring.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::mesh {
namespace {

std::array<double, 3> coordinates(const MeshPoint& p) {
  return {p.x, p.y, p.z};
}

/// The component of twice the Newell normal along `axis`, with (i, j, axis) cyclic:
/// Σ (a_i·b_j − a_j·b_i) over the edges ab.
Dyadic newell_component(std::span<const MeshPoint> ring, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Dyadic sum;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto a = coordinates(ring[k]);
    const auto b = coordinates(ring[k + 1 == ring.size() ? 0 : k + 1]);
    sum += Dyadic(a[i]) * Dyadic(b[j]);
    sum -= Dyadic(a[j]) * Dyadic(b[i]);
  }
  return sum;
}

int exact_projection_axis(std::span<const MeshPoint> ring) {
  int best = -1;
  Dyadic greatest;
  for (int axis = 0; axis < 3; ++axis) {
    Dyadic size = abs(newell_component(ring, axis));
    if (size > greatest) {
      greatest = std::move(size);
      best = axis;
    }
  }
  return best;
}

/// exact_projection_axis() in binary64, or −2 where the error bounds leave it open.
///
/// Bound. With a, b relative to the first corner, each difference is rounded once, so each of the
/// 2(n−1) products carries a relative error of at most (1+u)³ − 1 < 3.01u, u = 2⁻⁵³, and the sum of
/// m = 2n terms one of at most (m−1)u more, relative to S = Σ |products|, which is at most
/// 1 + (m+3)u times what is computed for it. All told that is less than (m + 2.01)u + 2m²u², where
/// 2m²u² ≤ u/4 for n ≤ 2²⁴. Hence |error| ≤ (2n + 4)·u·S for n < 2²⁴. An underflowing product adds
/// at most 2⁻¹⁰⁷⁵ each; S ≥ 2⁻⁹⁰⁰ makes that less than u·S·2⁻¹⁰⁰, covered by the 4. An overflow
/// makes S infinite and is left to the exact test.
int filtered_projection_axis(std::span<const MeshPoint> ring) {
  if (ring.size() >= (std::size_t{1} << 24)) return -2;
  std::array<double, 3> sum{}, size{};
  const auto origin = coordinates(ring[0]);
  std::array<double, 3> a{};
  for (std::size_t k = 1; k < ring.size(); ++k) {
    auto b = coordinates(ring[k]);
    for (int i = 0; i < 3; ++i) b[i] -= origin[i];
    for (int axis = 0; axis < 3; ++axis) {
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      const double left = a[i] * b[j], right = a[j] * b[i];
      sum[axis] += left - right;
      size[axis] += std::abs(left) + std::abs(right);
    }
    a = b;
  }
  const double u = unit_roundoff<double> * static_cast<double>(2 * ring.size() + 4);
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(sum[axis]) > std::abs(sum[best])) best = axis;
  if (!(size[best] >= 0x1p-900 && size[best] < std::numeric_limits<double>::infinity())) return -2;
  // The bounds are themselves rounded: the factor 1 + 2⁻²⁰ outweighs that many times over.
  const double least = std::abs(sum[best]) - u * size[best] * (1 + 0x1p-20);
  if (!(least > 0)) return -2;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == best) continue;
    const double greatest = std::abs(sum[axis]) + u * size[axis] * (1 + 0x1p-20) + 0x1p-1000;
    if (!(greatest * (1 + 0x1p-50) < least * (1 - 0x1p-50))) return -2;
  }
  return best;
}

/// The ring in its plane of projection.
std::vector<Point2> project(std::span<const MeshPoint> ring, int axis) {
  std::vector<Point2> result;
  result.reserve(ring.size());
  for (const MeshPoint& p : ring) {
    const auto c = coordinates(p);
    result.push_back({c[(axis + 1) % 3], c[(axis + 2) % 3]});
  }
  return result;
}

Triangulation fan(std::size_t n, Triangulation kind,
                  std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (Corner k = 1; k + 1 < n; ++k) triangles.push_back({0, k, k + 1});
  return kind;
}

}  // namespace

int projection_axis(std::span<const MeshPoint> ring) {
  const int axis = filtered_projection_axis(ring);
  return axis == -2 ? exact_projection_axis(ring) : axis;
}

Triangulation triangulate_face(std::span<const MeshPoint> ring,
                               std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (ring.size() == 3) return fan(3, Triangulation::convex_fan, triangles);
  const int axis = projection_axis(ring);
  if (axis < 0) return fan(ring.size(), Triangulation::fallback_fan, triangles);
  const std::vector<Point2> points = project(ring, axis);
  const std::vector<Corner> curve = without_repeats(points);
  if (is_convex(points, curve)) return fan(ring.size(), Triangulation::convex_fan, triangles);
  if (!is_simple(points, curve)) return fan(ring.size(), Triangulation::fallback_fan, triangles);
  return clip_ears(points, way_of(points, curve), triangles);
}

}  // namespace fathom::mesh
