#include "fathom/rays/tree_elements.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/round_outwards.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/rays/ray_bounds.h"
#include "fathom/threads/threads.h"

namespace fathom::rays {
namespace {

/// Whether n is not 0, exactly: n is 0 only for a triangle without area.
bool has_area(const PlacedTriangles::Corners& corners, double corner_error,
              const TriangleSource& source, std::uint32_t number) {
  Vector p, r;
  double H = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = corners[1][k] - corners[0][k];
    r[k] = corners[2][k] - corners[0][k];
    H = std::max({H, std::abs(p[k]), std::abs(r[k])});
  }
  const double error =
      (bounds::of_normal * H * H + bounds::of_normal_corners * corner_error * H) * bounds::slack +
      bounds::floor;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (std::abs(p[i] * r[j] - p[j] * r[i]) > error) return true;
  }
  const auto [a, b, c] = source.world_corners(number);
  const ExactVector3 n = cross(difference(b, a), difference(c, a));
  return !std::ranges::all_of(n, &Dyadic::is_zero);
}

FloatBox box_of(const PlacedTriangles::Corners& corners, double corner_error) {
  FloatBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [least, greatest] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
    // The error is 0, or greater than what the sum is rounded by.
    box.lower[k] = round_down(least - 2 * corner_error);
    box.upper[k] = round_up(greatest + 2 * corner_error);
  }
  return box;
}

}  // namespace

std::vector<Element> elements_of(const TriangleSource& source, const PlacedTriangles& triangles,
                                 double corner_error) {
  constexpr std::size_t together = 4096;
  std::vector<Element> elements(triangles.count());
  const std::size_t pieces = (elements.size() + together - 1) / together;
  parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
    const std::size_t end = std::min(elements.size(), (piece + 1) * together);
    for (std::size_t i = piece * together; i < end; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      if (!has_area(triangles[number], corner_error, source, number)) continue;
      elements[i] = {box_of(triangles[number], corner_error), number};
    }
  });
  // Those that were left out have empty boxes.
  std::erase_if(elements, [](const Element& e) { return e.box.lower[0] > e.box.upper[0]; });
  return elements;
}

std::vector<bool> objects_with_exact_corners(const TriangleSource& source, long power) {
  const double least = std::ldexp(1.0, static_cast<int>(power) - 960);
  const auto is_kept = [&](double x) { return x == 0 || std::abs(x) >= least; };
  const std::vector<Object>& objects = source.objects();
  std::vector<bool> are_exact(objects.size(), true);
  source.for_each_part(0, [&](const TriangleSource::Part& part) {
    const bool are_kept = part.object.placed_as_is &&
                          std::ranges::all_of(part.mesh.vertices, [&](const MeshPoint& p) {
                            return is_kept(p.x) && is_kept(p.y) && is_kept(p.z);
                          });
    if (!are_kept) are_exact[static_cast<std::size_t>(&part.object - objects.data())] = false;
  });
  return are_exact;
}

bool are_in_binary32(const PlacedTriangles& triangles) {
  const auto is_binary32 = [](double x) { return static_cast<float>(x) == x; };
  for (std::uint32_t i = 0; i < triangles.count(); ++i)
    for (const Vector& corner : triangles[i])
      if (!std::ranges::all_of(corner, is_binary32)) return false;
  return true;
}

}  // namespace fathom::rays
