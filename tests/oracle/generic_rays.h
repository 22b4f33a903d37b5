#pragma once

#include "tests/oracle/ray_caster.h"

/// The slow answer to what a ray meets (specification, section 11): brute force over all triangles
/// in rational numbers. The origin really is moved: everything is a polynomial in ε, and a sign is
/// that of the first coefficient that is not 0. Nothing of the library.
namespace fathom::oracle {

struct GivenRay {
  Vector origin, direction;
};

/// Which hits count; without a limit: all on that side.
struct Stretch {
  std::optional<Q> first = Q(0), last;
  bool open = false;
  /// −1: front faces are left out, 1: back faces.
  int left_out = 0;
};

struct RayHit {
  std::uint32_t triangle = 0;
  Q t;
  Vector point;
  /// Of any length, turned against the ray.
  Vector normal;
  Q weight_b, weight_c;
  /// −1 where the triangle shows its front, 1 where it shows its back.
  int side = 0;
  /// The sign of t where the moved ray meets the triangle, never 0.
  int moved_side = 0;
};

/// Every hit that counts, by t, then by number.
std::vector<RayHit> hits_of(const GivenRay& line, const std::vector<Triangle>& triangles,
                            const Stretch& stretch);

/// How often the surface winds around a point, seen along a direction.
int winding_number(const Vector& point, const Vector& direction,
                   const std::vector<Triangle>& triangles);

/// The numbers as they are.
Vector exact_vector(const std::array<double, 3>& v);

}  // namespace fathom::oracle
