#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/gltf/gltf_asset.h"
#include "fathom/mesh_files/gltf/gltf_primitive_accessors.h"

/// Triangles of glTF meshes. Only for .cpp files of this module.
/// Source   [GLTF20] 3.7.2 (geometry); [KMQ22]
namespace fathom::mesh_files {

class GltfPrimitives {
 public:
  /// `accessors` and `materials` must outlive this; `materials` is null if they are not wanted.
  GltfPrimitives(GltfAccessors& accessors, const GltfMaterials* materials, bool attributes,
                 bool lines_and_points)
      : accessors_(accessors),
        materials_(materials),
        attributes_(attributes),
        lines_and_points_(lines_and_points) {}

  /// All primitives of a glTF mesh in order. Primitives of the same accessors share their vertices.
  Mesh read(const text::JsonValue& mesh);

  /// Whether positions were read that are integers.
  [[nodiscard]] bool has_quantized_positions() const { return quantized_positions_; }
  /// Warns of what was skipped.
  void report(const std::string& file, Warnings& warnings) const;

 private:
  struct Vertices {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool has_texture = false, has_normals = false;
  };
  void read_primitive(const text::JsonValue& primitive, Mesh& mesh);
  void add_triangles(std::uint64_t mode, std::size_t corners, const Vertices& vertices,
                     const text::JsonValue& primitive, bool indexed, Mesh& mesh);
  void add_lines_or_points(std::uint64_t mode, std::size_t corners, const Vertices& vertices,
                           bool indexed, Mesh& mesh);
  /// The vertex of the mesh that a corner of the primitive is.
  [[nodiscard]] std::uint32_t vertex_of(std::size_t corner, const Vertices& vertices,
                                        bool indexed) const {
    return vertices.first + (indexed ? corners_[corner] : static_cast<std::uint32_t>(corner));
  }
  const Vertices& vertices_of(const GltfPrimitiveAccessors& accessors, Mesh& mesh);
  void read_positions(const GltfAccessor& positions, Mesh& mesh);
  void read_attributes(const GltfPrimitiveAccessors& accessors, Vertices& vertices, Mesh& mesh);
  /// Appends an attribute of the vertices; false if the primitive has no usable attribute of this
  /// kind.
  template <class Value, class Convert>
  bool read_attribute(const GltfAccessor* accessor, bool (*is_of_type)(const GltfAccessor&),
                      const Vertices& vertices, const Value& missing, std::vector<Value>& values,
                      const Convert& convert);
  void read_indices(const text::JsonValue& primitive, const GltfAccessor& indices,
                    const Vertices& vertices);
  void settle_attributes(Mesh& mesh);
  void settle_materials(Mesh& mesh);
  /// Makes room for `more` elements, if the budget allows it. Many primitives are appended to one
  /// list: it at least doubles when it grows, so that this takes linear time.
  template <class List>
  void make_room(List& list, std::uint64_t more);

  GltfAccessors& accessors_;
  const GltfMaterials* materials_;
  bool attributes_, lines_and_points_;

  // For the mesh that is being read: vertices by the accessors of their attributes.
  std::map<std::array<std::shared_ptr<const GltfAccessor>, 4>, Vertices> vertices_;
  // For each run of triangles, where it ends and which attributes it has.
  struct Run {
    std::size_t end = 0;
    bool has_texture = false, has_normals = false;
    /// The number of the material, if it has one.
    std::optional<std::size_t> material;
  };
  std::vector<Run> runs_;
  // For the primitive that is being read.
  std::vector<std::uint32_t> corners_;

  bool quantized_positions_ = false;
  std::uint64_t not_triangles_ = 0, without_positions_ = 0, leftover_corners_ = 0;
  std::uint64_t unusable_attributes_ = 0, missing_materials_ = 0;
};

}  // namespace fathom::mesh_files
