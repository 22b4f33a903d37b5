#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// The values of a hit, each the exact number rounded once to Real (specification, section 11).
template <class Real>
struct HitValues {
  Real t = 0;
  /// t·│direction│
  Real distance = 0;
  /// origin + t·direction
  std::array<Real, 3> position{};
  /// The weights of the corners B and C.
  std::array<Real, 2> barycentric{};
  /// The unit normal, turned against the ray.
  std::array<Real, 3> normal{};
  /// Whether (B − A) × (C − A) points against the ray.
  bool front_facing = false;
};

/// The values where a ray meets nothing (specification, section 11).
template <class Real>
constexpr HitValues<Real> values_without_hit() {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  return {infinity, infinity, {nan, nan, nan}, {nan, nan}, {}, false};
}

/// The values where a ray meets a triangle that a cast has found; all by exact numbers.
/// Fails    std::out_of_range if there is no such triangle; UsageError if the ray does not meet it.
template <class Real>
HitValues<Real> hit_values(const TriangleSource& triangles, const Ray& ray, std::uint32_t triangle);

/// The values of many hits: of rays[i] and triangle met[i], or values_without_hit() if met[i] is
/// no_triangle. 0 threads: all.
template <class Real>
std::vector<HitValues<Real>> hit_values(const TriangleSource& triangles, std::span<const Ray> rays,
                                        std::span<const std::uint32_t> met, int threads = 0);

}  // namespace fathom
