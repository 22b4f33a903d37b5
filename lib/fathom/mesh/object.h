#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "fathom/geometry/frames.h"
#include "fathom/mesh/segmentation.h"

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
  /// What comes before the segments of its mesh; null: nothing. Instances share it.
  std::shared_ptr<const ObjectSegments> segments = nullptr;
};

/// How much memory the numbers of a transform take, in bytes: they grow with every transform that
/// it is composed of.
std::uint64_t bytes_of(const WorldFromMesh& transform);
/// The same of an object, with its name and its transform.
std::uint64_t bytes_of(const Object& object);

/// The numbers of a transform are below 2 to this power, and of so many bits from the highest of
/// them all to the lowest that is not 0: beyond either, exact numbers take long for every pixel.
/// Rotations and scalings in each other stay below the second as deep as glTF nodes may be, 200.
inline constexpr long greatest_power_of_transform = 2048;
inline constexpr long most_bits_of_transform = 40000;
/// Which of the two a transform is beyond.
std::optional<std::string> find_fault(const WorldFromMesh& transform);

/// A point of the object's mesh in the world, exactly; scene units.
inline WorldPoint to_world(const Object& object, const MeshPoint& p) {
  return object.placed_as_is ? WorldPoint{p.x, p.y, p.z} : object.world_from_mesh(p);
}

}  // namespace fathom
