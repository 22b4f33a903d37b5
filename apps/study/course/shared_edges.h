#pragma once

#include <cstdint>

#include "apps/study/scene_files.h"

namespace fathom::studies {

/// A mesh of narrow triangles on the subpixel grid: how often its samples are covered. Every
/// triangle is asked about every sample, by what the pipeline decides with (subpixel_grid.h): the
/// pipeline's pictures show only one triangle at each.
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

/// The mesh that was snapped, a pixel for each of its samples: triangles that were turned over come
/// first, in red, and hide those behind them that are at the same depth; the others are blue.
SceneFiles shared_edges_files(int bits);
/// As the pipeline draws it.
RgbImage shared_edges_picture(int bits);

}  // namespace fathom::studies
