#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"

namespace fathom {

/// Triangles by number, whether the scene is in memory or in files. Refers to the scene, which
/// must outlive it unchanged. Thread-safe.
/// Fails    std::out_of_range unless `number` is below count(); InputError if a file of a
///          StreamedScene has changed or cannot be read any more, or if the requested triangle has
///          a fault. require_valid() (scene_fault.h) checks the whole scene.
class TriangleSource {
 public:
  /// Fails    InputError if an object names no mesh, or there are more than 2³² − 2 triangles: one
  ///          mesh may be placed often.
  TriangleSource(const Scene& scene);          // implicit: a scene is a source,
  TriangleSource(const StreamedScene& scene);  // and so is this one

  /// The scene that the triangles are from: one of these two, the other is null.
  [[nodiscard]] const Scene* scene() const { return scene_; }
  [[nodiscard]] const StreamedScene* streamed_scene() const { return streamed_; }

  /// The number of triangles.
  [[nodiscard]] std::uint64_t count() const { return first_numbers_.back(); }
  [[nodiscard]] const std::vector<Object>& objects() const {
    return scene_ ? scene_->objects : streamed_->objects;
  }

  /// Where a triangle comes from, by bisection over the objects.
  [[nodiscard]] TriangleOrigin origin(std::uint32_t number) const;
  struct Triangle {
    TriangleOrigin origin;
    /// In the frame of the object's mesh.
    std::array<MeshPoint, 3> corners;
  };
  [[nodiscard]] Triangle triangle(std::uint32_t number) const;
  /// The label of a triangle of a StreamedScene in its file, or `unsegmented`. (SceneSegments has
  /// the labels of any scene.)
  [[nodiscard]] std::uint32_t label(const TriangleOrigin& origin) const;
  /// The corners in the world, exactly.
  [[nodiscard]] std::array<WorldPoint, 3> world_corners(std::uint32_t number) const;

  /// A part of an object: `mesh` holds its triangles from `first_number` on.
  struct Part {
    const Object& object;
    const Mesh& mesh;
    std::uint32_t first_number;
  };
  /// Calls visit(part) for parts that together are the scene, in the order of their triangles, one
  /// after another in this thread: whole objects in memory, at most `triangles_of_file` triangles
  /// of a file. Parts where wanted(their first number) is false are left out, and not read.
  void for_each_part(
      std::uint32_t triangles_of_file, const std::function<void(const Part&)>& visit,
      const std::function<bool(std::uint32_t)>& wanted = [](std::uint32_t) { return true; }) const;

 private:
  /// An object, and the number of a triangle within it.
  struct Place {
    std::uint32_t object, triangle;
  };
  [[nodiscard]] Place place_of(std::uint32_t number) const;
  [[nodiscard]] const TriangleStream& stream(std::uint32_t object) const {
    return *streamed_->streams[streamed_->objects[object].mesh];
  }

  const Scene* scene_ = nullptr;
  const StreamedScene* streamed_ = nullptr;
  /// Number of each object's first triangle, and of all triangles.
  std::vector<std::uint64_t> first_numbers_{0};
};

}  // namespace fathom
