#include "apps/bench/parts/closed_edges.h"

#include "apps/bench/parts/exact_picture.h"
#include "apps/study/course/demo.h"

namespace fathom::bench {

std::vector<RuleCounts> closed_edges_of_demo() {
  const studies::Demo demo = studies::demo();
  return {{"demo, near triangle", demo.near_fragments, demo.near_closed},
          {"demo, far triangle", demo.far_fragments, demo.far_closed}};
}

RuleCounts closed_edges(const std::string& name, const SnappedScene& scene) {
  return {name, covered_pixels(scene, EdgeRule::half_open),
          covered_pixels(scene, EdgeRule::closed)};
}

}  // namespace fathom::bench
