#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/effort.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/camera/camera.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/scene.h"

/// Z-buffer, painter's algorithm, Warnock's subdivision and a tree of planes, compared with the
/// exact visible triangle and with each other.
namespace fathom::studies {

/// The textbooks' cases, by name.
struct HiddenSurfaceScene {
  std::string name;
  Scene scene;
};
std::vector<HiddenSurfaceScene> hidden_surface_scenes();
/// Their camera: 160 × 160 pixels. No edge runs through a sample, where snapping would decide.
Camera hidden_surface_camera();

struct TreeErrors {
  std::size_t wrong = 0;     ///< pixels
  std::uint64_t pieces = 0;  ///< of polygons, one in each node
};

/// One of the textbooks' cases: the numbers of pixels that show a wrong triangle.
struct HiddenSurfaceCase {
  std::string name;
  std::size_t seen = 0;  ///< pixels with a surface
  std::size_t buffer16 = 0, buffer32 = 0, painter = 0, warnock = 0;
  /// The same tree in three arithmetics.
  TreeErrors bsp_tree, bsp_exact_outlines, bsp_exact;
  pipeline::PainterStatistics order;
  RgbImage picture;              ///< the painter's, by the pipeline
  std::vector<StudyFile> files;  ///< the scene and the camera that it is drawn from
};
std::vector<HiddenSurfaceCase> compare_hidden_surfaces();
/// The same for a scene of one mesh in the camera's frame.
HiddenSurfaceCase compare_hidden_surfaces(const std::string& name, const Scene& scene,
                                          const Camera& camera);

/// The cost of a frame with one algorithm on this machine.
struct FrameCost {
  double ms = 0;  ///< the least of several frames
  /// The peak memory of a separate frame; nullopt if the system does not measure it.
  std::optional<std::uint64_t> bytes;
};

struct HiddenSurfaceCost {
  std::size_t triangles = 0;
  FrameCost buffer, painter, warnock, bsp_tree;
  std::uint64_t comparisons = 0, splits = 0;
  std::uint64_t warnock_windows = 0;  ///< that were looked at
  std::uint64_t bsp_tree_pieces = 0;  ///< of polygons, one in each node
};
/// Of a scene of one mesh in the camera's frame.
HiddenSurfaceCost hidden_surface_cost(const Scene& scene, const Camera& camera);
/// Of random triangles, 320 × 240 pixels.
HiddenSurfaceCost hidden_surface_cost(std::uint32_t triangles);

}  // namespace fathom::studies
