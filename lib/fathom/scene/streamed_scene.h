#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "fathom/mesh_files/triangle_stream.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// A scene whose meshes stay in their files: binary STL and PLY that need not fit into memory.
/// Triangles, objects and faces have the numbers that they would have in a Scene.
struct StreamedScene {
  /// One object per file, in order, placed as it is; `mesh` is its index into `streams`.
  std::vector<Object> objects;
  std::vector<std::unique_ptr<TriangleStream>> streams;
  std::vector<Source> sources;
};

/// Opens the files as one scene. Of the options, only `format`, `hash`, `segments`,
/// `check_when_opened` and `map_large_files` matter.
/// Fails    InputError, as open_triangle_stream() and read_scene() do.
StreamedScene stream_scene(const std::vector<std::filesystem::path>& files,
                           const ReadOptions& options, Warnings& warnings);

/// The same as for a Scene.
std::uint64_t triangle_count(const StreamedScene& scene);
TriangleOrigin origin_of(const StreamedScene& scene, std::uint32_t number);

/// A scene in memory with the same objects, sources and world_bounds(), in which each mesh is a
/// single triangle that spans its bounds, or empty if it has none: enough to make cameras from.
/// Fails    InputError if the scene has a fault (find_fault).
Scene outline_of(const StreamedScene& scene);

}  // namespace fathom
