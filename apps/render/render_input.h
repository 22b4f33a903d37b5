#pragma once

#include <optional>

#include "apps/options/motion_options.h"
#include "apps/options/scene_options.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// What is rendered: a scene in memory, or one that stays in its files.
class RenderInput {
 public:
  enum class Place { memory, files };

  /// What channels need of the files beside positions.
  struct Kept {
    /// Materials, groups, parts and labels.
    bool segments = false;
    bool normals = false;
  };

  RenderInput(const SceneOptions& options, Place place, const Kept& kept, const Console& console);

  /// The scene; of one that stays in its files its bounds, objects and sources: what cameras are
  /// made from.
  [[nodiscard]] const Scene& outline() const { return scene_; }
  /// Places the objects that move.
  /// Fails    UsageError where the scene stays in its files; as MotionOptions::placed.
  void place(const MotionOptions& motion);
  [[nodiscard]] TriangleSource triangles() const;
  [[nodiscard]] DepthMap render(const Camera& camera, const RenderOptions& options) const;

 private:
  Scene scene_;
  std::optional<StreamedScene> streamed_;
};

}  // namespace fathom::app
