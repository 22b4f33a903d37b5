#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/idea.h"

/// The ideas, one file each. What they draw is kept by their variants; the scene has to outlive
/// them.
namespace fathom::bench {

/// A scene to draw, as it is and as it reaches scan conversion.
struct PartsScene {
  explicit PartsScene(BenchScene its_scene)
      : bench(std::move(its_scene)), window(snapped(bench)), setups(set_up_edges(window)) {}
  BenchScene bench;
  SnappedScene window;
  std::vector<EdgeSetup> setups;
};

/// 1, 2, 4, 8 and 16 pixels of a row at once: in binary32, in binary64, and the fast engine with
/// each width of vectors that the processor has.
std::vector<Idea> lanes(const PartsScene& scene);
/// Blocks of pixels before pixels: in the textbook's loop, in the pipeline, in the fast engine.
std::vector<Idea> blocks(const PartsScene& scene);
/// The depth test before shading, and the fast engine's rejection of blocks, by the order in which
/// triangles are drawn.
std::vector<Idea> early_rejection(const PartsScene& scene);
/// Tiles with a z-buffer of their own, of several sizes, beside the whole image.
std::vector<Idea> tiles(const PartsScene& scene);
/// One thread and more.
std::vector<Idea> threads(const PartsScene& scene, const std::vector<int>& counts);
/// Back faces left out; no idea where that changes the picture, as it does if a mesh is not closed.
std::vector<Idea> culling(const PartsScene& scene);

/// "lanes", "blocks", "early-rejection", "tiles", "threads", "culling".
const std::vector<std::string>& idea_names();
/// The ideas of a name. Fails    UsageError if there is none.
std::vector<Idea> ideas_named(const std::string& name, const PartsScene& scene,
                              const std::vector<int>& thread_counts);

}  // namespace fathom::bench
