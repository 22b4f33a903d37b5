#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "tests/inputs/random_scenes.h"

/// Random small scenes, each drawn from a family that is hard for a reason of its own. Images are
/// 8×6; the same family and seed give the same scene on every machine.
namespace fathom::checks {

enum class Family {
  slivers,           // triangles a few units in the last place wide
  samples_on_edges,  // samples on edges and corners
  ties,              // equal triangles, and equal depths on different planes
  midpoints,         // depths and positions halfway between two binary32 numbers, or nearly
  coplanar_heaps,    // many triangles of one plane
  around_the_eye,    // corners behind the camera and in its plane
  intrinsics,        // focal lengths, skew and principal points of any magnitude
  cancellation,      // coordinates far from the origin that the camera's pose cancels
  range_ends,        // depths at near and far, or next to them
  placements,        // placed, mirrored, flattened and tiny meshes
  exponents,         // exponents from −1060 to 1020, each by itself
  conspiracies,      // extreme numbers whose products are ordinary
  cameras,           // near, far, fx, fy, cx, cy and depths of any exponent, of an ordinary image
};
inline constexpr std::array all_families{
    Family::slivers,        Family::samples_on_edges, Family::ties,       Family::midpoints,
    Family::coplanar_heaps, Family::around_the_eye,   Family::intrinsics, Family::cancellation,
    Family::range_ends,     Family::placements,       Family::exponents,  Family::conspiracies,
    Family::cameras};
std::string name_of(Family family);

/// A scene and a camera without fault.
Case adversarial_case(Family family, std::uint64_t seed);

}  // namespace fathom::checks
