#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/oracle/ray_caster.h"

/// Normals that are interpolated, the slow and obvious way, in rational numbers.
namespace fathom::oracle {

struct SmoothMesh {
  std::vector<Vector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Those that the corners of each triangle have of their own; empty: none has.
  std::vector<std::array<std::optional<Vector>, 3>> normals;
  /// Whether vertices at one place share their normals.
  bool by_place = false;
};

/// The linear part of a placement, by rows.
using Linear = std::array<Vector, 3>;

/// The normal of a corner in the world, of any length: all of a triangle's by one factor.
Vector corner_normal(const SmoothMesh& mesh, const Linear& placement, std::uint32_t triangle,
                     std::size_t corner);

/// Interpolated with weights of B and C.
Vector smooth_normal(const SmoothMesh& mesh, const Linear& placement, std::uint32_t triangle,
                     const Q& weight_b, const Q& weight_c);

}  // namespace fathom::oracle
