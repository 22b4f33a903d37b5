#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "fathom/rendering/options.h"

/// Rays and the options of a cast (specification, section 11).
namespace fathom {

/// The points origin + t·direction of the world, in scene units. The numbers are taken exactly. t
/// counts lengths of the direction, which need not be 1.
struct Ray {
  std::array<double, 3> origin{}, direction{};
};

/// Which hits of a ray count: t_min ≤ t ≤ t_max, or t_min < t < t_max if `open`. t_min may be −∞.
struct RaySegment {
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  bool open = false;
};

/// Which points of its edges a triangle has.
enum class EdgeRule {
  /// The points that the rule of section 11 assigns to it: an edge between two triangles belongs to
  /// one of them.
  generic,
  /// All.
  closed
};
inline constexpr std::array all_edge_rules{EdgeRule::closed, EdgeRule::generic};
constexpr std::string_view name_of(EdgeRule rule) {
  return rule == EdgeRule::closed ? "closed" : "generic";
}

struct CastOptions {
  RaySegment segment;
  /// A triangle (A, B, C) is front-facing for a ray if (B − A) × (C − A) points against it.
  Cull cull = Cull::none;
  /// Threads to use; 0: all.
  int threads = 0;
};

/// "No triangle is met."
inline constexpr std::uint32_t no_triangle = 0xFFFFFFFF;

/// Where a ray meets a triangle.
struct RayHit {
  std::uint32_t triangle = no_triangle;
  /// Rounded once; +∞ if no triangle is met.
  double t = std::numeric_limits<double>::infinity();

  friend bool operator==(const RayHit&, const RayHit&) = default;
};

}  // namespace fathom
