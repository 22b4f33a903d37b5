#include "fathom/rays/repeated_triangles.h"

#include <algorithm>
#include <array>

namespace fathom::rays {
namespace {

bool same_place(const WorldPoint& a, const WorldPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Of triangles whose placed corners are equal: these may have been rounded.
bool have_same_corners(const TriangleSource& source, std::uint32_t a, std::uint32_t b) {
  const auto of_a = source.world_corners(a), of_b = source.world_corners(b);
  return std::ranges::equal(of_a, of_b, same_place);
}

}  // namespace

Elements without_repetitions(Elements crowd, const PlacedTriangles& triangles,
                             const TriangleSource& source, std::vector<Repetition>& repeated) {
  std::ranges::sort(crowd, [&](const Element& a, const Element& b) {
    const auto &of_a = triangles[a.number], &of_b = triangles[b.number];
    return of_a == of_b ? a.number < b.number : of_a < of_b;
  });
  std::size_t kept = 0, first = 0;
  for (const Element& element : crowd) {
    const bool is_first = kept == 0 || triangles[crowd[first].number] != triangles[element.number];
    if (is_first) first = kept;
    if (!is_first && have_same_corners(source, crowd[first].number, element.number)) {
      repeated.push_back({crowd[first].number, element.number});
    } else {
      crowd[kept++] = element;
    }
  }
  return crowd.first(kept);
}

}  // namespace fathom::rays
