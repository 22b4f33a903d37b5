#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/options/motion_options.h"
#include "apps/options/scene_options.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::app {

/// Some of the triangles of a scene, as a scene of its own, whose objects have them in their order.
struct ScenePart {
  Scene scene;
  /// Where the triangles of each object are from: triangle t is number first + t of the mesh of this
  /// object.
  struct From {
    std::uint32_t object, first;
  };
  std::vector<From> from;
};

/// A scene of which all ranks know objects and sources, and whose triangles they share out. Binary
/// STL and PLY stay in their files, of which a rank keeps nothing but its part; of an STL it reads no
/// more. Of other formats, every rank has all.
class SharedScene {
 public:
  struct Kept {
    /// Materials, groups, parts and labels; normals. Where they are asked for, files are read whole.
    bool segments = false, normals = false;
    /// SHA-256 of the sources, which one rank is enough for.
    bool hash = false;
  };
  /// Fails    as SceneOptions::read() and stream_scene(); UsageError for standard input.
  SharedScene(const SceneOptions& options, const Kept& kept, const Console& console);

  /// Places the objects that move.
  /// Fails    as MotionOptions::placed; UsageError where triangles stay in their files.
  void place(const MotionOptions& motion);
  /// Completes the outline by the bounds of what only parts have seen; called by all ranks, with the
  /// parts that together are the scene.
  void find_bounds(const Ranks& ranks, const ScenePart& part);
  /// The scene; of one that stays in its files its objects and sources and, after find_bounds(), its
  /// bounds.
  [[nodiscard]] const Scene& outline() const { return scene_; }
  /// Whether the outline is the whole scene.
  [[nodiscard]] bool is_whole() const { return !streamed_; }
  [[nodiscard]] TriangleSource triangles() const;
  /// The numbers of the objects' first triangles, and of all triangles.
  [[nodiscard]] const std::vector<std::uint64_t>& first_numbers() const { return first_numbers_; }
  /// The triangles first ≤ number < end.
  [[nodiscard]] ScenePart part(std::uint64_t first, std::uint64_t end) const;
  /// What is the same in all ranks if they read the same files.
  [[nodiscard]] std::string description() const;

 private:
  Scene scene_;
  std::optional<StreamedScene> streamed_;
  std::vector<std::uint64_t> first_numbers_{0};
};

}  // namespace fathom::app
