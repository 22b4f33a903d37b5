#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "fathom/geometry/frames.h"

namespace fathom {

/// A mesh placed in the world: a mesh file, or a glTF node with a mesh.
struct Object {
  /// Index into Scene::meshes; several objects may share a mesh.
  std::size_t mesh = 0;
  WorldFromMesh world_from_mesh;
  /// True where `world_from_mesh` is the identity, the common case.
  bool placed_as_is = true;
  std::string name;
  /// Number of this object's first face in its file (glTF: faces are counted over all its nodes).
  std::uint64_t first_face = 0;
  /// Index into Scene::sources of the file that the mesh comes from.
  std::size_t source = 0;
};

/// A point of the object's mesh in the world, exactly; scene units.
inline WorldPoint to_world(const Object& object, const MeshPoint& p) {
  return object.placed_as_is ? WorldPoint{p.x, p.y, p.z} : object.world_from_mesh(p);
}

}  // namespace fathom
