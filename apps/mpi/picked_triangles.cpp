#include "apps/mpi/picked_triangles.h"

namespace fathom::app {

Mesh TrianglePicker::picked(std::span<const std::uint32_t> triangles) {
  if (places_.empty()) places_.assign(mesh_.vertices.size(), no_index);
  Mesh result;
  result.triangles.reserve(triangles.size());
  std::vector<std::uint32_t> used;
  for (const std::uint32_t number : triangles) {
    CornerIndices corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh_.triangles[number][i];
      std::uint32_t& place = places_.at(vertex);
      if (place == no_index) {
        place = static_cast<std::uint32_t>(used.size());
        used.push_back(vertex);
      }
      corners[i] = place;
    }
    result.triangles.push_back(corners);
  }
  result.vertices.reserve(used.size());
  for (const std::uint32_t vertex : used) {
    result.vertices.push_back(mesh_.vertices[vertex]);
    places_[vertex] = no_index;
  }
  return result;
}

}  // namespace fathom::app
