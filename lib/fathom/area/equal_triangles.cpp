#include "fathom/area/equal_triangles.h"

#include <algorithm>
#include <array>

namespace fathom::area {
namespace {

using Corners = std::array<WorldPoint, 3>;

bool same_place(const WorldPoint& a, const WorldPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// The same whichever corner comes first.
std::size_t hash_of(const Corners& corners) {
  std::size_t sum = 0;
  for (const WorldPoint& p : corners) {
    std::size_t hash = 0;
    for (const Dyadic* x : {&p.x, &p.y, &p.z}) hash = hash * 31 + fathom::hash_of(*x);
    sum += hash ^ hash >> 29;
  }
  return sum;
}

bool have_same_corners(const Corners& a, Corners b) {
  for (int turn = 0; turn < 3; ++turn) {
    if (std::equal(a.begin(), a.end(), b.begin(), same_place)) return true;
    std::rotate(b.begin(), b.begin() + 1, b.end());
  }
  return false;
}

}  // namespace

bool EqualTriangles::is_first(std::uint32_t number) {
  const Corners corners = triangles_.world_corners(number);
  const std::size_t hash = hash_of(corners);
  const auto [first, end] = by_hash_.equal_range(hash);
  for (auto other = first; other != end; ++other) {
    if (have_same_corners(triangles_.world_corners(other->second), corners)) return false;
  }
  by_hash_.emplace(hash, number);
  return true;
}

}  // namespace fathom::area
