#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fathom/rays/sight.h"
#include "tests/oracle/ray_caster.h"
#include "tests/rays/ray_cases.h"

/// Pairs of points of which much coincides with the scenes of ray_cases.h, or is out of proportion.
namespace fathom::rays::test {

/// Where rays of the case begin and lead to, corners, points of edges and of triangles, and points
/// of their planes.
std::vector<std::pair<SightPoint, SightPoint>> draw_pairs(const RayCase& from, std::uint64_t seed);

/// Of the scene with these triangles.
oracle::Vector rational_point(const SightPoint& point, const std::vector<oracle::Triangle>& all);

/// A constructor of the point, in hexadecimal.
std::string text_of(const SightPoint& point);

}  // namespace fathom::rays::test
