#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/gltf_accessor.h"
#include "fathom/text/warnings.h"

/// Triangles of glTF meshes. For this room's .cpp files only.
/// Source   [GLTF20] 3.7.2 (geometry)
namespace fathom::mesh_files {

class GltfPrimitives {
 public:
  /// `root` and `buffers` must outlive this.
  GltfPrimitives(const text::JsonValue& root, GltfBuffers& buffers, bool attributes,
                 std::uint64_t file_size)
      : root_(root), buffers_(buffers), attributes_(attributes), file_size_(file_size) {}

  /// All primitives of a glTF mesh in order. Primitives that name the same attributes share their
  /// vertices.
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
  const Vertices& vertices_of(const text::JsonValue& attributes, Mesh& mesh);
  void read_positions(const GltfAccessor& positions, Mesh& mesh) const;
  void read_attributes(const text::JsonValue& attributes, Vertices& vertices, Mesh& mesh);
  std::vector<std::uint32_t> read_indices(const text::JsonValue& primitive,
                                          const Vertices& vertices);
  GltfAccessor open(const text::JsonValue& reference) {
    return {root_, buffers_, reference, file_size_};
  }

  text::JsonValue root_;
  GltfBuffers& buffers_;
  bool attributes_;
  std::uint64_t file_size_;

  // For the mesh that is being read: vertices by the accessors of their attributes.
  std::map<std::array<std::uint64_t, 4>, Vertices> vertices_;
  // For each run of triangles, where it ends and which attributes it has.
  struct Run {
    std::size_t end = 0;
    bool has_texture = false, has_normals = false;
  };
  std::vector<Run> runs_;

  std::uint64_t not_triangles_ = 0, without_positions_ = 0, leftover_corners_ = 0;
};

}  // namespace fathom::mesh_files
