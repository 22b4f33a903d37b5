#include "validation/scenes/generated/soup_stream.h"

#include <vector>

#include "validation/scenes/made/scattered.h"

namespace fathom::bench {
namespace {

/// The k-th 21 bits of a number, as a number in [0, 1).
double part_of(std::uint64_t bits, int k) {
  return static_cast<double>(bits >> (21 * k) & 0x1FFFFF) * 0x1p-21;
}

/// A point in the unit cube.
MeshPoint random_point(std::uint64_t number) {
  const std::uint64_t bits = scattered(number);
  return {part_of(bits, 0), part_of(bits, 1), part_of(bits, 2)};
}

/// The k-th of the points that belong to a triangle.
MeshPoint point_of(std::uint32_t triangle, std::uint64_t k) {
  return random_point(4 * std::uint64_t{triangle} + k);
}

}  // namespace

SoupStream::SoupStream(std::uint32_t count, double edge)
    : GeneratedStream(count, {{0, 0, 0}, {1, 1, 1}}), edge_(edge) {}

// No coordinate is above 1: with (1 − edge) rounded to the nearest, its sum with the edge is 1
// within half a unit in the last place, and rounding is monotone.
TriangleStream::Triangle SoupStream::triangle(std::uint32_t number) const {
  const MeshPoint place = point_of(number, 3);
  const double room = 1 - edge_;
  Triangle result{.corners = {}, .face = number};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const MeshPoint within = point_of(number, k);
    result.corners[k] = {as_in_a_file(room * place.x + edge_ * within.x),
                         as_in_a_file(room * place.y + edge_ * within.y),
                         as_in_a_file(room * place.z + edge_ * within.z)};
  }
  return result;
}

void SoupStream::add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const {
  std::vector<MeshPoint>& vertices = mesh.vertices.own();
  std::vector<CornerIndices>& triangles = mesh.triangles.own();
  vertices.reserve(3 * std::size_t{end - first});
  for (std::uint32_t number = first; number < end; ++number) {
    const auto vertex = static_cast<std::uint32_t>(vertices.size());
    const Triangle made = triangle(number);
    vertices.insert(vertices.end(), made.corners.begin(), made.corners.end());
    triangles.push_back({vertex, vertex + 1, vertex + 2});
  }
}

}  // namespace fathom::bench
