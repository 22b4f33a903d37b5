#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/scene/mesh.h"

namespace fathom {

/// A mesh placed in the world: a mesh file, or a glTF node with a mesh.
struct Object {
  /// Index into Scene::meshes; several objects may share a mesh.
  std::size_t mesh = 0;
  WorldFromMesh world_from_mesh;
  /// True where `world_from_mesh` is the identity, the common case.
  bool placed_as_is = true;
  std::string name;
  /// Number, in its file, of this object's first face (glTF: faces run over all nodes of a file).
  std::uint64_t first_face = 0;
  /// Index into Scene::sources of the file that the mesh comes from.
  std::size_t source = 0;
};

/// A file that went into a scene, for provenance.
struct Source {
  std::string path;
  /// 64 hexadecimal digits.
  std::string sha256;
};

/// Everything that is rendered. Triangles are numbered from 0 over all objects in order
/// (specification, section 3), at most 2³² − 2 in all.
struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Source> sources;
};

/// Number of triangles over all objects.
std::uint64_t triangle_count(const Scene& scene);

/// Where triangle `number` of the scene comes from.
struct TriangleOrigin {
  std::uint32_t object = 0;
  /// Number within its object's mesh.
  std::uint32_t triangle = 0;
  /// Number of its face within its file.
  std::uint32_t face = 0;
};
TriangleOrigin origin_of(const Scene& scene, std::uint32_t number);

}  // namespace fathom
