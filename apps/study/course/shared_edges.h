#pragma once

#include <cstdint>
#include <vector>

#include "apps/study/pipeline_scenes.h"
#include "fathom/image/rgb_image.h"

/// Triangles that share edges, on the subpixel grid.
namespace fathom::studies {

/// How often the samples of a mesh of narrow triangles on the subpixel grid are covered. Every
/// triangle is tested at every sample with the pipeline's functions (subpixel_grid.h), because the
/// pipeline's pictures show only one triangle at each sample.
struct SharedEdges {
  int bits = 0;
  std::uint64_t triangles = 0, turned_over = 0, without_area = 0;
  std::uint64_t samples = 0;
  std::uint64_t signed_not_one = 0;     ///< samples, counted by orientation
  std::uint64_t unsigned_not_one = 0;   ///< samples, every triangle counted
  std::uint64_t unexplained = 0;        ///< of these, with no triangle that was turned over
  std::uint64_t covers = 0;             ///< samples covered, over all triangles
  std::vector<bool> covered_by_turned;  ///< for each sample, row by row
};
SharedEdges count_shared_edges(int bits);

/// The snapped mesh, with a pixel for each of its samples. Triangles that were turned over are red;
/// they come first and so hide other triangles at the same depth. All other triangles are blue.
SceneFiles shared_edges_files(int bits);
/// The pipeline's picture of it.
RgbImage shared_edges_picture(int bits);

}  // namespace fathom::studies
