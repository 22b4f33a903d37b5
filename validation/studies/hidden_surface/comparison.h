#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/scene.h"
#include "validation/studies/scene_files.h"

/// Z-buffer, painter's algorithm, Warnock's subdivision and a tree of planes, compared with the exact
/// visible triangle and with each other.
namespace fathom::studies {

/// The textbooks' cases, by name.
struct HiddenSurfaceScene {
  std::string name;
  Scene scene;
};
std::vector<HiddenSurfaceScene> hidden_surface_scenes();
/// What sees them: 160 × 160 pixels, and no edge runs through a sample, where snapping would decide.
Camera hidden_surface_camera();

/// One of the textbooks' cases: pixels at which another triangle than the exact one is seen.
struct HiddenSurfaceCase {
  std::string name;
  std::size_t seen = 0;  ///< pixels with a surface
  std::size_t buffer16 = 0, buffer32 = 0, painter = 0, warnock = 0, bsp_tree = 0;
  pipeline::PainterStatistics order;
  RgbImage picture;              ///< the painter's, by the pipeline
  std::vector<StudyFile> files;  ///< the scene and the camera that it is drawn from
};
std::vector<HiddenSurfaceCase> compare_hidden_surfaces();

/// Random triangles, 320 × 240 pixels: the least time of five frames, here. Bytes: a float32 for each
/// pixel, and the polygons, with their attributes, that have to be there to be sorted.
struct HiddenSurfaceCost {
  std::uint32_t triangles;
  double buffer_ms, painter_ms, warnock_ms, bsp_tree_ms;
  std::uint64_t buffer_bytes, painter_bytes;
  std::uint64_t comparisons, splits;
  std::uint64_t warnock_windows;  ///< that were looked at
  std::uint64_t bsp_tree_pieces;  ///< of polygons, one in each node
};
HiddenSurfaceCost hidden_surface_cost(std::uint32_t triangles);

}  // namespace fathom::studies
