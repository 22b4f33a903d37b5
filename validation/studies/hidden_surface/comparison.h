#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/pipeline/render_pipeline.h"

/// Z-buffer and painter's algorithm, compared with the exact visible triangle and with each other.
namespace fathom::studies {

/// One of the textbooks' cases: pixels at which another triangle than the exact one is seen.
struct HiddenSurfaceCase {
  std::string name;
  std::size_t seen = 0;  ///< pixels with a surface
  std::size_t buffer16 = 0, buffer32 = 0, painter = 0;
  pipeline::PainterStatistics order;
  RgbImage picture;  ///< the painter's
};
std::vector<HiddenSurfaceCase> compare_hidden_surfaces();

/// Random triangles, 320 × 240 pixels: the least time of five frames, here.
struct HiddenSurfaceCost {
  std::uint32_t triangles;
  double buffer_ms, painter_ms;
  std::uint64_t comparisons, splits;
};
HiddenSurfaceCost hidden_surface_cost(std::uint32_t triangles);

}  // namespace fathom::studies
