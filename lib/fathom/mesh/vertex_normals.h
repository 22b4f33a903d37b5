#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "fathom/mesh/mesh.h"

namespace fathom {

/// The origin of the normals of corners. `file`: the file, or like `vertex` for corners without a
/// normal. `vertex`: the sum over the triangles at the vertex. `place`: the sum over the triangles
/// at all vertices of the mesh with the same position. The sums add up (B − A) × (C − A), so that
/// triangles have the weight of their areas.
enum class NormalSource { file, vertex, place };
/// "file", "vertex" or "place".
std::string_view name_of(NormalSource source);

}  // namespace fathom

/// Which normals belong to which corners, for exact and for rounded sums.
namespace fathom::mesh {

/// The index of a corner's normal in the normals of the file; no_index if the corner has no normal.
std::uint32_t normal_index(const Mesh& mesh, std::size_t triangle, std::size_t corner);

/// Whether the normals of some corners are sums over triangles.
bool needs_sums(const Mesh& mesh, NormalSource source);

/// For each vertex the first vertex that shares its normal; itself if it is the first.
std::vector<std::uint32_t> sharing_vertices(const Mesh& mesh, NormalSource source);

/// The triangles over which the normals of a mesh's vertices are summed up.
/// Cost     12 bytes for each triangle and 12 for each vertex.
class SharedTriangles {
 public:
  /// Nothing is shared: for meshes that need no sums.
  SharedTriangles() = default;
  /// Fails    InputError if a triangle has a corner beyond the vertices.
  SharedTriangles(const Mesh& mesh, NormalSource source);

  /// The vertex that represents all vertices that share the normal of this vertex.
  [[nodiscard]] std::uint32_t shared(std::uint32_t vertex) const { return first_[vertex]; }
  /// The triangles of the sum of such a vertex, in the order of their numbers; twice where two
  /// corners of a triangle share it.
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t shared) const {
    return std::span(triangles_).subspan(starts_[shared], starts_[shared + 1] - starts_[shared]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace fathom::mesh
