#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/options/scene_options.h"
#include "apps/render/render_arguments.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/channels.h"

namespace fathom::app {

/// Triangles of a scene, first ≤ number < end.
struct TriangleRange {
  std::uint64_t first = 0, end = 0;
  [[nodiscard]] std::uint64_t count() const { return end - first; }
  /// Fewer than `most` triangles, beginning with number first + from.
  [[nodiscard]] TriangleRange part(std::uint64_t from, std::uint64_t most) const {
    const std::uint64_t begin = first + std::min(from, count());
    return {begin, begin + std::min(most, end - begin)};
  }
};

/// A scene whose objects and sources are the same in all ranks, and whose triangles are divided
/// among the ranks. Binary STL and PLY stay in their files, and a rank keeps only its part of them.
/// Of an STL, and of a PLY with only triangles, it also reads only its part. Other formats are in
/// memory in every rank.
class SharedScene {
 public:
  struct Kept {
    /// Everything, in every rank.
    bool whole = false;
    /// Materials, groups, parts and labels; normals. If they are requested, files are read whole,
    /// too.
    bool segments = false, normals = false;
    /// SHA-256 of the sources; it is enough if one rank computes them.
    bool hash = false;
  };
  /// Fails    as SceneOptions::read() and stream_scene(); UsageError for standard input.
  SharedScene(const SceneOptions& options, const Kept& kept, const Console& console);
  /// A given scene, the same in all ranks. Bounds that its streams have are used unchanged.
  /// Fails    InputError where it has a fault (find_fault).
  explicit SharedScene(StreamedScene scene);

  /// Checks the data that was not checked when files were opened: each rank its part, or, if a file
  /// is not what its size suggests, all ranks the whole file. Called by all ranks before any other
  /// function of the scene.
  /// Fails    as the constructor, in all ranks.
  void check_files(const Ranks& ranks, const Console& console);
  /// Places the objects that move.
  /// Fails    as MotionOptions::placed.
  void place(const MotionOptions& motion);
  /// Adds the bounds of streamed meshes to the outline. Each rank reads its part, so many triangles
  /// at a time. Called by all ranks.
  /// Fails    as part(), in all ranks.
  void find_bounds(const Ranks& ranks, std::uint32_t triangles_at_once);
  /// The scene; for a streamed scene only its objects and sources and, after find_bounds(), its
  /// bounds.
  [[nodiscard]] const Scene& outline() const { return scene_; }
  /// Whether the outline is the whole scene.
  [[nodiscard]] bool is_whole() const { return !streamed_; }
  [[nodiscard]] TriangleSource triangles() const;
  /// Renders a map of the scene in this rank only.
  [[nodiscard]] Rendered render(const Camera& camera, const RenderOptions& options) const;
  /// The triangles that a rank reads.
  [[nodiscard]] TriangleRange part_of(const Ranks& ranks) const;
  /// The numbers of the objects' first triangles, and of all triangles.
  [[nodiscard]] const std::vector<std::uint64_t>& first_numbers() const { return first_numbers_; }
  /// The triangles of a range, as a list for each object with triangles in it.
  /// Fails    InputError where a file has changed, or a triangle of it a fault.
  [[nodiscard]] std::vector<SomeTriangles> read(const TriangleRange& range) const;
  /// A text that is equal in all ranks if they read the same files.
  [[nodiscard]] std::string description() const;

 private:
  void open(bool check, const Console& console);
  void number_triangles();

  /// Streamed files, the options for opening them, and the warnings that were printed about them.
  std::vector<std::filesystem::path> files_;
  ReadOptions reading_;
  Warnings told_;
  Scene scene_;
  std::optional<StreamedScene> streamed_;
  std::vector<std::uint64_t> first_numbers_;
};

// Both are called by all ranks.

/// Fails    as SharedScene; InputError where the ranks read different files.
SharedScene open_scene(const Ranks& ranks, const RenderArguments& arguments,
                       const SharedScene::Kept& kept, const Console& console);
/// The requested cameras. Also places moving objects and warns about requested channels of segments
/// that the scene does not have.
/// Fails    as CameraOptions::get(); InputError if the ranks have different cameras.
std::vector<Camera> cameras_of(const Ranks& ranks, const RenderArguments& arguments,
                               const std::vector<Channel>& channels, SharedScene& scene,
                               const Console& console);

}  // namespace fathom::app
