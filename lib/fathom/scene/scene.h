#pragma once

#include <cstdint>
#include <vector>

#include "fathom/files/source.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"
#include "fathom/scene/draw_state.h"

namespace fathom {

/// Everything that is rendered. Callers may fill it in; find_fault() checks whether it is valid.
/// Triangles are numbered from 0 over all objects in order (specification, section 3), at most
/// 2³² − 2 in all.
struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Source> sources;
  /// How a pipeline draws each object; empty where it draws all of them as it always does.
  std::vector<DrawState> draw_states;
};

/// How a pipeline draws an object.
DrawState draw_state_of(const Scene& scene, std::size_t object);

/// The number of triangles in all objects.
/// Fails    InputError where an object names no mesh, or there are more than can be numbered.
std::uint64_t triangle_count(const Scene& scene);

/// Where triangle `number` of the scene comes from.
struct TriangleOrigin {
  std::uint32_t object = 0;
  /// Its number within its object's mesh.
  std::uint32_t triangle = 0;
  /// The number of its face within its file.
  std::uint32_t face = 0;
};
/// Cost     constructs a TriangleSource; for many triangles construct it once yourself.
/// Fails    std::out_of_range unless `number` is below triangle_count().
TriangleOrigin origin_of(const Scene& scene, std::uint32_t number);

}  // namespace fathom
