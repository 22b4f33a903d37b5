#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/parts/snapped_scene.h"

namespace fathom::bench {

/// Pixels by the two rules of EdgeRule.
struct RuleCounts {
  std::string name;
  std::uint64_t half_open = 0, closed = 0;
};

/// The demo of the textbooks (study/course/demo.h): its near and its far triangle.
std::vector<RuleCounts> closed_edges_of_demo();

/// The pixels that the triangles of a scene cover, each triangle counted for itself. Closed edges
/// count a centre on an edge that two triangles share twice.
RuleCounts closed_edges(const std::string& name, const SnappedScene& scene);

}  // namespace fathom::bench
