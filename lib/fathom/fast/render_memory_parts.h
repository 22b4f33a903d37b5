#pragma once

#include <memory>
#include <vector>

#include "fathom/fast/bins.h"
#include "fathom/fast/render_memory.h"
#include "fathom/fast/tile.h"
#include "fathom/threads/per_thread.h"

namespace fathom {

struct RenderMemory::Parts {
  fast::VertexMemory vertices;
  std::vector<fast::Bins> bins;
  PerThread<std::unique_ptr<fast::Tile>> tiles{[] { return std::make_unique<fast::Tile>(); }};
};

}  // namespace fathom
