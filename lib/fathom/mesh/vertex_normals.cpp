#include "fathom/mesh/vertex_normals.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom {

std::string_view name_of(NormalSource source) {
  return source == NormalSource::file     ? "file"
         : source == NormalSource::vertex ? "vertex"
                                          : "place";
}

}  // namespace fathom

namespace fathom::mesh {

std::uint32_t normal_index(const Mesh& mesh, std::size_t triangle, std::size_t corner) {
  const std::uint32_t index = mesh.normal_triangles.empty()
                                  ? mesh.triangles[triangle][corner]
                                  : mesh.normal_triangles[triangle][corner];
  return index < mesh.normals.size() ? index : no_index;
}

bool needs_sums(const Mesh& mesh, NormalSource source) {
  if (source != NormalSource::file || mesh.normals.empty()) return true;
  return std::ranges::any_of(mesh.normal_triangles, [](const CornerIndices& t) {
    return std::ranges::find(t, no_index) != t.end();
  });
}

std::vector<std::uint32_t> sharing_vertices(const Mesh& mesh, NormalSource source) {
  std::vector<std::uint32_t> first(mesh.vertices.size());
  std::iota(first.begin(), first.end(), 0U);
  if (source != NormalSource::place) return first;
  const auto place = [&](std::uint32_t v) {
    const MeshPoint& p = mesh.vertices[v];
    return std::array{p.x, p.y, p.z};
  };
  // Vertices by place, those at one place in their order.
  std::vector<std::uint32_t> sorted = first;
  std::ranges::stable_sort(sorted,
                           [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (place(sorted[i]) == place(sorted[i - 1])) first[sorted[i]] = first[sorted[i - 1]];
  }
  return first;
}

SharedTriangles::SharedTriangles(const Mesh& mesh, NormalSource source)
    : first_(sharing_vertices(mesh, source)), starts_(first_.size() + 1) {
  for (const CornerIndices& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      if (v >= first_.size()) {
        throw InputError("scene: there is no vertex " + std::to_string(v) + " among " +
                         std::to_string(first_.size()));
      }
      ++starts_[first_[v] + 1];
    }
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  triangles_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) triangles_[next[first_[v]]++] = t;
  }
}

}  // namespace fathom::mesh
