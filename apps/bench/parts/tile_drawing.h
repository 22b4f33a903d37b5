#pragma once

#include "apps/bench/parts/edge_kernels.h"

namespace fathom::bench {

struct TileCounts {
  std::uint64_t tiles = 0;
  /// Pairs of a triangle and a tile that its box meets.
  std::uint64_t pairs = 0;
  /// Tiles of the thread that drew most.
  std::uint64_t most_of_a_thread = 0;
};

/// The nearest triangles of an image, tile by tile: triangles are sorted into square tiles of
/// `side` pixels by their boxes, and each thread draws tiles into a small z-buffer of its own,
/// which it copies to the image.
TileCounts draw_in_tiles(std::span<const EdgeSetup> setups, std::uint32_t side, int threads,
                         DepthImage& image);

}  // namespace fathom::bench
