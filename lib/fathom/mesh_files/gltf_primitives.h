#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/gltf_primitive_accessors.h"
#include "fathom/text/warnings.h"

/// Triangles of glTF meshes. For this room's .cpp files only.
/// Source   [GLTF20] 3.7.2 (geometry)
namespace fathom::mesh_files {

class GltfPrimitives {
 public:
  /// `accessors` must outlive this.
  GltfPrimitives(GltfAccessors& accessors, bool attributes)
      : accessors_(accessors), attributes_(attributes) {}

  /// All primitives of a glTF mesh in order. Primitives of the same accessors share their vertices.
  Mesh read(const text::JsonValue& mesh);

  /// Warns of what was skipped.
  void report(const std::string& file, Warnings& warnings) const;

 private:
  struct Vertices {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool has_texture = false, has_normals = false;
  };
  void read_primitive(const text::JsonValue& primitive, Mesh& mesh);
  const Vertices& vertices_of(const GltfPrimitiveAccessors& accessors, Mesh& mesh);
  void read_positions(const GltfAccessor& positions, Mesh& mesh) const;
  void read_attributes(const GltfPrimitiveAccessors& accessors, Vertices& vertices,
                       Mesh& mesh) const;
  [[nodiscard]] std::vector<std::uint32_t> read_indices(const text::JsonValue& primitive,
                                                        const GltfAccessor* indices,
                                                        const Vertices& vertices) const;

  GltfAccessors& accessors_;
  bool attributes_;

  // For the mesh that is being read: vertices by the accessors of their attributes.
  std::map<std::array<std::shared_ptr<const GltfAccessor>, 4>, Vertices> vertices_;
  // For each run of triangles, where it ends and which attributes it has.
  struct Run {
    std::size_t end = 0;
    bool has_texture = false, has_normals = false;
  };
  std::vector<Run> runs_;

  std::uint64_t not_triangles_ = 0, without_positions_ = 0, leftover_corners_ = 0;
};

}  // namespace fathom::mesh_files
