#pragma once

#include <array>
#include <optional>

#include "fathom/scene/scene.h"

namespace fathom {

/// A box along the axes of the world, in scene units.
struct WorldBounds {
  std::array<double, 3> lower{};
  std::array<double, 3> upper{};
  friend bool operator==(const WorldBounds&, const WorldBounds&) = default;
};

/// The smallest box of binary64 numbers in the world that contains every corner of every triangle,
/// line and point; unused vertices do not count. nullopt for an empty scene.
///
/// Exact    corners are placed exactly; the exact extremes are rounded outwards, once. An end
///          beyond the largest binary64 number is infinite.
/// Fails    InputError if the scene has a fault (find_fault).
std::optional<WorldBounds> world_bounds(const Scene& scene);

}  // namespace fathom
